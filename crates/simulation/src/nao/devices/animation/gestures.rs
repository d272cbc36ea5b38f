//! The gestures of the simulated robot, of our own making: for each joint when it is where, in milliseconds and radians.

use super::BACK_MS;
use crate::model::motor;

/// A gesture.
pub(super) struct Gesture {
    /// The name of the gesture in files.
    pub(super) name: &'static str,
    /// The name among those that are installed, as on a NAO6; empty if none of them is like it.
    pub(super) path: &'static str,
    /// The name for people.
    pub(super) words: &'static str,
    pub(super) rows: &'static [JointKeys],
}

/// A joint and its keys; it begins and ends where it was.
pub(super) struct JointKeys(&'static str, &'static [(u64, f32)]);

const NOD: &[(u64, f32)] = &[(300, 0.35), (600, -0.10), (900, 0.35), (1_200, -0.10)];
const SHAKE: &[(u64, f32)] = &[(300, 0.45), (700, -0.45), (1_100, 0.45), (1_500, -0.45)];
const WAVE: &[(u64, f32)] = &[(700, 0.6), (1_000, 1.3), (1_300, 0.6), (1_600, 1.3), (1_900, 0.6), (2_200, 1.3)];

const WAVE_LEFT: &[(u64, f32)] =
    &[(700, -0.6), (1_000, -1.3), (1_300, -0.6), (1_600, -1.3), (1_900, -0.6), (2_200, -1.3)];

/// All gestures; `robot` says which there are.
pub(super) const GESTURES: &[Gesture] = &[
    Gesture {
        name: "Hey",
        path: "animations/Stand/Gestures/Hey_1",
        words: "waving",
        rows: &[
            JointKeys("RShoulderPitch", &[(700, -0.9), (2_200, -0.9)]),
            JointKeys("RShoulderRoll", &[(700, -0.3), (2_200, -0.3)]),
            JointKeys("RElbowYaw", &[(700, 1.2), (2_200, 1.2)]),
            JointKeys("RElbowRoll", WAVE),
            JointKeys("RHand", &[(700, 0.9), (2_200, 0.9)]),
        ],
    },
    Gesture {
        name: "Yes",
        path: "animations/Stand/Gestures/Yes_1",
        words: "nodding",
        rows: &[JointKeys("HeadPitch", NOD)],
    },
    Gesture {
        name: "No",
        path: "animations/Stand/Gestures/No_1",
        words: "shaking the head",
        rows: &[JointKeys("HeadYaw", SHAKE)],
    },
    Gesture {
        name: "Bow",
        path: "animations/Stand/Gestures/BowShort_1",
        words: "bowing",
        rows: &[
            JointKeys("HeadPitch", &[(800, 0.5), (1_600, 0.5)]),
            JointKeys("LShoulderPitch", &[(800, 1.75), (1_600, 1.75)]),
            JointKeys("RShoulderPitch", &[(800, 1.75), (1_600, 1.75)]),
        ],
    },
    Gesture {
        name: "Me",
        path: "animations/Stand/Gestures/Me_1",
        words: "pointing to itself",
        rows: &[
            JointKeys("RShoulderPitch", &[(700, 1.0), (1_700, 1.0)]),
            JointKeys("RShoulderRoll", &[(700, 0.2), (1_700, 0.2)]),
            JointKeys("RElbowYaw", &[(700, 0.3), (1_700, 0.3)]),
            JointKeys("RElbowRoll", &[(700, 1.5), (1_700, 1.5)]),
        ],
    },
    Gesture {
        name: "Explain",
        path: "animations/Stand/Gestures/Explain_1",
        words: "explaining",
        rows: &[
            JointKeys("LShoulderPitch", &[(600, 0.9), (1_200, 1.2), (1_800, 0.9)]),
            JointKeys("LElbowRoll", &[(600, -1.3), (1_200, -0.9), (1_800, -1.3)]),
            JointKeys("LHand", &[(600, 0.9), (1_800, 0.9)]),
            JointKeys("RShoulderPitch", &[(600, 1.2), (1_200, 0.9), (1_800, 1.2)]),
            JointKeys("RElbowRoll", &[(600, 0.9), (1_200, 1.3), (1_800, 0.9)]),
            JointKeys("RHand", &[(600, 0.9), (1_800, 0.9)]),
        ],
    },
    Gesture {
        name: "Happy",
        path: "animations/Stand/Emotions/Positive/Happy_4",
        words: "cheering",
        rows: &[
            JointKeys("HeadPitch", &[(600, -0.4), (1_800, -0.4)]),
            JointKeys("LShoulderPitch", &[(600, -1.2), (1_000, -0.8), (1_400, -1.2), (1_800, -0.8)]),
            JointKeys("RShoulderPitch", &[(600, -1.2), (1_000, -0.8), (1_400, -1.2), (1_800, -0.8)]),
            JointKeys("LHand", &[(600, 1.0), (1_800, 1.0)]),
            JointKeys("RHand", &[(600, 1.0), (1_800, 1.0)]),
        ],
    },
    Gesture {
        name: "Dance",
        path: "animations/Stand/Waiting/FunnyDancer_1",
        words: "dancing",
        rows: &[
            JointKeys(
                "HeadYaw",
                &[(500, 0.4), (1_000, -0.4), (1_500, 0.4), (2_000, -0.4), (2_500, 0.4), (3_000, -0.4)],
            ),
            JointKeys(
                "LShoulderPitch",
                &[(500, 0.2), (1_000, 1.2), (1_500, 0.2), (2_000, 1.2), (2_500, 0.2), (3_000, 1.2)],
            ),
            JointKeys(
                "RShoulderPitch",
                &[(500, 1.2), (1_000, 0.2), (1_500, 1.2), (2_000, 0.2), (2_500, 1.2), (3_000, 0.2)],
            ),
            JointKeys("LElbowRoll", &[(500, -1.2), (3_000, -1.2)]),
            JointKeys("RElbowRoll", &[(500, 1.2), (3_000, 1.2)]),
        ],
    },
    Gesture {
        name: "Clap",
        path: "animations/Stand/Gestures/Applause_1",
        words: "clapping",
        rows: &[
            JointKeys("LShoulderPitch", &[(700, 0.6), (2_300, 0.6)]),
            JointKeys("RShoulderPitch", &[(700, 0.6), (2_300, 0.6)]),
            JointKeys("LElbowRoll", &[(700, -1.0), (2_300, -1.0)]),
            JointKeys("RElbowRoll", &[(700, 1.0), (2_300, 1.0)]),
            JointKeys(
                "LShoulderRoll",
                &[(700, 0.3), (1_000, -0.1), (1_300, 0.3), (1_600, -0.1), (1_900, 0.3), (2_300, -0.1)],
            ),
            JointKeys(
                "RShoulderRoll",
                &[(700, -0.3), (1_000, 0.1), (1_300, -0.3), (1_600, 0.1), (1_900, -0.3), (2_300, 0.1)],
            ),
            JointKeys("LHand", &[(700, 0.8), (2_300, 0.8)]),
            JointKeys("RHand", &[(700, 0.8), (2_300, 0.8)]),
        ],
    },
    Gesture {
        name: "Surprised",
        path: "animations/Stand/Emotions/Negative/Surprise_1",
        words: "acting surprised",
        rows: &[
            JointKeys("HeadPitch", &[(400, -0.4), (1_600, -0.4)]),
            JointKeys("LShoulderPitch", &[(500, 0.5), (1_600, 0.5)]),
            JointKeys("RShoulderPitch", &[(500, 0.5), (1_600, 0.5)]),
            JointKeys("LElbowRoll", &[(500, -1.4), (1_600, -1.4)]),
            JointKeys("RElbowRoll", &[(500, 1.4), (1_600, 1.4)]),
            JointKeys("LHand", &[(400, 1.0), (1_600, 1.0)]),
            JointKeys("RHand", &[(400, 1.0), (1_600, 1.0)]),
        ],
    },
    Gesture {
        name: "HighFive",
        path: "",
        words: "giving a high five",
        rows: &[
            JointKeys("RShoulderPitch", &[(800, -0.8), (3_000, -0.8)]),
            JointKeys("RShoulderRoll", &[(800, -0.1), (3_000, -0.1)]),
            JointKeys("RElbowRoll", &[(800, 0.4), (3_000, 0.4)]),
            JointKeys("RHand", &[(800, 1.0), (3_000, 1.0)]),
        ],
    },
    Gesture {
        name: "HeyLeft",
        path: "",
        words: "waving the left hand",
        rows: &[
            JointKeys("LShoulderPitch", &[(700, -0.9), (2_200, -0.9)]),
            JointKeys("LShoulderRoll", &[(700, 0.3), (2_200, 0.3)]),
            JointKeys("LElbowYaw", &[(700, -1.2), (2_200, -1.2)]),
            JointKeys("LElbowRoll", WAVE_LEFT),
            JointKeys("LHand", &[(700, 0.9), (2_200, 0.9)]),
        ],
    },
];

impl Gesture {
    /// Returns the time until all joints are back, in milliseconds.
    pub(super) fn lasts_ms(&self) -> u64 {
        self.rows.iter().map(JointKeys::lasts_ms).max().unwrap_or(0)
    }
}

impl JointKeys {
    pub(super) fn motor(&self) -> Option<usize> {
        motor(self.0)
    }

    fn lasts_ms(&self) -> u64 {
        self.1.last().map_or(0, |key| key.0) + BACK_MS
    }

    /// Where the joint shall be so long after the beginning, linear between the keys.
    pub(super) fn angle(&self, start: f32, at: u64) -> f32 {
        let mut before = (0, start);
        for key in self.1.iter().chain(&[(self.lasts_ms(), start)]) {
            if at < key.0 {
                let part = (at - before.0) as f32 / (key.0 - before.0) as f32;
                return before.1 + (key.1 - before.1) * part;
            }
            before = *key;
        }
        start
    }
}

#[cfg(test)]
mod tests {
    use super::GESTURES;
    use crate::model::BodyModel;
    use behaviour::StreamKind;
    use robot::ParamKind;

    #[test]
    fn there_is_every_gesture_of_the_catalogue_in_its_words() {
        let device = robot::device(StreamKind::Actuator, "Animation").expect("it is in the catalogue");
        let ParamKind::Choice(choices) = device.params[0].kind else { panic!("a choice") };
        let (another, fixed) = choices.split_last().expect("some");
        assert_eq!(another.0, "robot");
        assert_eq!(GESTURES.iter().map(|one| (one.name, one.words)).collect::<Vec<_>>(), fixed);
    }

    #[test]
    fn keys_are_in_order_inside_the_limits_and_slow_enough() {
        let motors = &BodyModel::nao().motors;
        for row in GESTURES.iter().flat_map(|gesture| gesture.rows) {
            let motor = &motors[row.motor().expect("a joint of the robot")];
            assert!(row.1.iter().all(|key| (motor.limits[0]..=motor.limits[1]).contains(&key.1)), "{}", row.0);
            for pair in row.1.windows(2) {
                let seconds = (pair[1].0 - pair[0].0) as f32 / 1_000.0;
                assert!((pair[1].1 - pair[0].1).abs() / seconds < 0.6 * motor.top_speed, "{}", row.0);
            }
        }
    }
}
