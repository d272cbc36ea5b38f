//! The words on senses and actions. The key of each says where it stands: `device.Bumper.foot.left`.

use crate::{Device, Field, Param, ParamKind, Pretend};
use phrase::Label;

impl Device {
    fn labelled(&self, place: &str, english: &'static str) -> Label {
        Label { key: format!("device.{}{place}", self.name), english }
    }

    /// The name on the page.
    #[must_use]
    pub fn called(&self) -> Label {
        self.labelled("", self.label)
    }

    /// The sentence that says what it does.
    #[must_use]
    pub fn described(&self) -> Label {
        self.labelled(".says", self.says)
    }

    /// The words by which it is offered as the next step of a stream.
    #[must_use]
    pub fn offered_as(&self) -> Label {
        self.next_step.label.map_or_else(|| self.called(), |label| self.labelled(".next", label))
    }

    /// The name of the stream that it makes as a next step.
    #[must_use]
    pub fn next_stream(&self) -> Label {
        self.next_step.stream.map_or_else(|| self.called(), |stream| self.labelled(".stream", stream))
    }

    /// The name of one of its parameters.
    #[must_use]
    pub fn param_called(&self, param: &Param) -> Label {
        self.labelled(&format!(".{}", param.name), param.label)
    }

    /// The name of one of the choices of a parameter, as `(in files, for people)`.
    #[must_use]
    pub fn choice_called(&self, param: &Param, (choice, english): (&str, &'static str)) -> Label {
        self.labelled(&format!(".{}.{choice}", param.name), english)
    }

    /// The unit of a parameter that is a number.
    #[must_use]
    pub fn unit_called(&self, param: &Param, unit: &'static str) -> Label {
        self.labelled(&format!(".{}.unit", param.name), unit)
    }

    /// The words on its button where nobody wrote others.
    pub(crate) fn usual_on_button(&self, param: &Param, text: &'static str) -> Label {
        self.labelled(&format!(".{}.usual", param.name), text)
    }

    /// The words for what can be pretended.
    #[must_use]
    pub fn pretend_called(&self, pretend: &Pretend) -> Label {
        let nth = self.pretend.iter().position(|known| known == pretend).unwrap_or_default();
        self.labelled(&format!(".pretend{nth}"), pretend.says)
    }

    /// The words for a field of its values.
    #[must_use]
    pub fn field_called(&self, field: &Field) -> Label {
        self.labelled(&format!(".field.{}", field.name), field.says)
    }

    /// Every word on it.
    #[must_use]
    pub fn labels(&self) -> Vec<Label> {
        let mut all = vec![self.called(), self.described(), self.offered_as(), self.next_stream()];
        all.extend(self.pretend.iter().map(|pretend| self.pretend_called(pretend)));
        all.extend(self.shape.fields().iter().map(|field| self.field_called(field)));
        all.extend(self.params.iter().flat_map(|param| self.labels_of(param)));
        all
    }

    fn labels_of(&self, param: &Param) -> Vec<Label> {
        let mut all = vec![self.param_called(param)];
        match param.kind {
            ParamKind::Choice(options) => all.extend(options.iter().map(|option| self.choice_called(param, *option))),
            ParamKind::Number { unit, .. } => all.push(self.unit_called(param, unit)),
            ParamKind::Text { default, .. } if self.button == Some(param.name) => {
                all.push(self.usual_on_button(param, default));
            }
            ParamKind::Text { .. } => {}
        }
        all
    }
}
