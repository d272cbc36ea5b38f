//! The target of the catalogue's Tracker and the part that follows it: as every robot reads its settings, and tells
//! people what it does.

/// A target that a tracker follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TrackTarget {
    /// The red ball.
    RedBall,
    /// The largest face in view.
    Face,
}

/// The part of the body that follows, besides an arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackMode {
    /// The head alone.
    Head,
    /// The head, and the whole body turns when the target is far aside.
    WholeBody,
    /// The head, and the robot walks to the target.
    Move,
    /// Nothing: the arm alone points.
    Arm,
}

impl TrackTarget {
    /// The target of a setting; none if it is no target.
    #[must_use]
    pub fn of(setting: &str) -> Option<Self> {
        match setting {
            "RedBall" => Some(Self::RedBall),
            "Face" => Some(Self::Face),
            _ => None,
        }
    }

    /// Returns the name of the target for people.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::RedBall => "red ball",
            Self::Face => "face",
        }
    }
}

impl TrackMode {
    /// The mode of a setting; none if it is no mode.
    #[must_use]
    pub fn of(setting: &str) -> Option<Self> {
        match setting {
            "Head" => Some(Self::Head),
            "WholeBody" => Some(Self::WholeBody),
            "Move" => Some(Self::Move),
            "Arm" => Some(Self::Arm),
            _ => None,
        }
    }

    /// True if it uses the legs.
    #[must_use]
    pub fn walks(self) -> bool {
        matches!(self, Self::WholeBody | Self::Move)
    }

    /// The name for people of what follows.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Head => "head",
            Self::WholeBody => "whole body",
            Self::Move => "walking",
            Self::Arm => "arm",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{TrackMode, TrackTarget};
    use crate::ParamKind;

    #[test]
    fn every_setting_of_the_catalogue_is_read() {
        let device = crate::actuators().find(|device| device.name == "Tracker").expect("there is one");
        let options = |name: &str| {
            let param = device.params.iter().find(|param| param.name == name).expect("it has it");
            let ParamKind::Choice(options) = param.kind else { panic!("{name} is no choice") };
            options
        };
        assert!(options("target").iter().all(|(target, _)| TrackTarget::of(target).is_some()));
        assert!(options("mode").iter().all(|(mode, _)| TrackMode::of(mode).is_some()));
        assert_eq!((TrackTarget::of("Sound"), TrackMode::of("")), (None, None));
    }
}
