//! The gallery: the sample applications of the thesis and some more, ready to be copied, changed and run.

use super::thumbnails::picture_of;
use behaviour::BehaviourFile;
use protocol::Summary;

/// A behaviour to begin with.
pub(crate) struct Template {
    /// Its name as people read it, the same as in the file.
    pub(crate) name: &'static str,
    /// What it does, in one sentence.
    pub(crate) says: &'static str,
    json: &'static str,
}

impl Template {
    /// A behaviour that begins something else than the gallery.
    pub(super) const fn of(name: &'static str, says: &'static str, json: &'static str) -> Self {
        Self { name, says, json }
    }

    /// The behaviour, with its layout and the helpers it uses.
    pub(crate) fn file(&self) -> BehaviourFile {
        #[expect(clippy::expect_used, reason = "the text is part of the program and a test reads every one")]
        serde_json::from_str(self.json).expect("a template is a behaviour file")
    }

    /// What the list of templates says about it.
    pub(crate) fn summary(&self) -> Summary {
        let file = self.file();
        Summary {
            id: self.name.to_owned(),
            name: self.name.to_owned(),
            revision: 0,
            changed_ms: 0,
            by: self.says.to_owned(),
            owner: String::new(),
            streams: u32::try_from(file.streams.len()).unwrap_or(u32::MAX),
            tags: Vec::new(),
            picture: file.records(|_| None).ok().map(|records| picture_of(&records)),
        }
    }
}

/// All templates: those of the thesis, the simplest first, then one for each connector that was added.
pub(crate) fn templates() -> &'static [Template] {
    TEMPLATES
}

const TEMPLATES: &[Template] = &[
    Template {
        name: "Reflect ball color",
        says: "The eyes take the color of the ball that the robot sees.",
        json: include_str!("../../../../tests/behaviours/reflect_ball_color.json"),
    },
    Template {
        name: "Say ball color",
        says: "Says the color of the ball that it sees, once a second.",
        json: include_str!("../../../../tests/behaviours/say_ball_color.json"),
    },
    Template {
        name: "Say ball color with merge",
        says: "The same with the colors brought together, so that only one action speaks.",
        json: include_str!("../../../../tests/behaviours/say_ball_color_merge.json"),
    },
    Template {
        name: "Distance to brightness",
        says: "The eyes shine brighter the nearer the red ball is.",
        json: include_str!("../../../../tests/behaviours/distance_to_brightness.json"),
    },
    Template {
        name: "Track far and close balls",
        says: "Follows a far ball with the head, and a close one with head and body.",
        json: include_str!("../../../../tests/behaviours/track_far_and_close.json"),
    },
    Template {
        name: "Greeter",
        says: "Says hello to a new face and remembers it; greets a known face again.",
        json: include_str!("../../../../tests/behaviours/greeter.json"),
    },
    Template {
        name: "Track with nearest arm",
        says: "Follows with head, body or the nearest arm by distance; old sightings can mislead the arm.",
        json: include_str!("../../../../tests/behaviours/track_nearest_arm.json"),
    },
    Template {
        name: "Track with nearest arm, in time",
        says: "The same, and the arm forgets a close ball that was not seen for a second.",
        json: include_str!("../../../../tests/behaviours/track_nearest_arm_in_time.json"),
    },
    Template {
        name: "Count my touches",
        says: "Counts how often its head was touched, and says the number.",
        json: include_str!("../../../../tests/behaviours/count_my_touches.json"),
    },
    Template {
        name: "Hello once",
        says: "Says hello once to whom it sees, and again only to somebody else.",
        json: include_str!("../../../../tests/behaviours/hello_once.json"),
    },
    Template {
        name: "Goodbye",
        says: "Looks at who is there, and says goodbye when it has seen nobody for eight seconds.",
        json: include_str!("../../../../tests/behaviours/goodbye.json"),
    },
    Template {
        name: "Touch to tell the color",
        says: "Touched on the head, it says the color of the ball that it saw last.",
        json: include_str!("../../../../tests/behaviours/touch_to_tell_the_color.json"),
    },
];

#[cfg(test)]
mod tests {
    use super::templates;
    use crate::rooms::knowledge::Knowing;
    use behaviour::{Helper, Problem, ProblemKind};

    #[test]
    fn every_template_has_the_name_of_its_file_and_a_sentence() {
        for template in templates() {
            assert_eq!(template.file().name, template.name);
            assert!(template.says.ends_with('.'), "{}", template.name);
        }
    }

    /// The one that its own sentence warns of is the example that the thesis mends (4.4.8).
    #[test]
    fn no_template_has_a_problem_save_the_one_that_says_so() {
        for template in templates() {
            let file = template.file();
            let (records, library) = (file.records(|_| None).unwrap(), file.library());
            let helpers: Vec<&Helper> = library.iter().collect();
            let found = behaviour::problems(&records, &helpers, &Knowing::default());
            let is_warned_of = |problem: &Problem| matches!(problem.kind, ProblemKind::StaleCombine { .. });
            let wrong = template.says.contains("old sightings can mislead");
            assert!(
                found.iter().all(|problem| is_warned_of(problem) && !problem.blocks),
                "{}: {found:?}",
                template.name
            );
            assert_eq!(found.len(), usize::from(wrong), "{}", template.name);
        }
    }

    #[test]
    fn templates_use_the_helpers_that_every_library_starts_with() {
        for template in templates() {
            for helper in template.file().library() {
                assert!(robot::shipped_helpers().contains(&helper), "{}: {}", template.name, helper.name);
            }
        }
    }

    #[test]
    fn every_template_is_kept_as_it_is_and_has_a_place_for_every_stream() {
        for template in templates() {
            let file = template.file();
            let records = file.records(|_| None).unwrap();
            let shipped = robot::shipped_helpers();
            let again = behaviour::BehaviourFile::of(&records, &shipped.iter().collect::<Vec<_>>());
            assert_eq!((again.streams, again.connectors), (file.streams.clone(), file.connectors), "{}", template.name);
            assert_eq!(again.layout, file.layout);
            assert!(file.helpers.iter().all(|helper| again.helpers.contains(helper)), "{}", template.name);
            assert!(file.streams.iter().all(|stream| file.layout.contains_key(&stream.id)), "{}", template.name);
        }
    }

    #[test]
    fn every_template_has_a_picture_of_its_graph() {
        for template in templates() {
            let (file, picture) = (template.file(), template.summary().picture.unwrap());
            assert_eq!(picture.streams.len(), file.streams.len(), "{}", template.name);
            let inputs: usize = file.connectors.iter().map(|connector| connector.inputs.len()).sum();
            assert_eq!(picture.lines.len(), inputs, "{}", template.name);
            for [from, to] in picture.lines {
                let (from, to) = (picture.streams[usize::from(from)], picture.streams[usize::from(to)]);
                assert!(from.y < to.y, "{}: values flow downwards", template.name);
            }
        }
    }

    #[test]
    fn every_template_runs_in_the_engine() {
        for template in templates() {
            let built = engine::Run::build(&template.file(), engine::Limits::default());
            assert!(built.is_ok(), "{}: {:?}", template.name, built.err());
        }
    }
}
