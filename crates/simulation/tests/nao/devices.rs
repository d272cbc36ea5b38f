//! Every device of the catalogue does on the simulated robot what it says: a scenario each.

mod acting;
mod body;
mod hearing;
mod moving;
mod seeing;
mod touching;

/// A test for each device, by its name in the catalogue.
macro_rules! scenarios {
    ($($name:literal $scenario:ident: $file:ident;)*) => {
        const TRIED: &[&str] = &[$($name),*];

        $(#[test]
        fn $scenario() {
            $file::$scenario();
        })*
    };
}

scenarios! {
    "RedBall" red_ball: seeing;
    "FaceDetection" face_detection: seeing;
    "HeadTouch" head_touch: touching;
    "ColorBall" color_ball: seeing;
    "Blob" blob: seeing;
    "People" people: seeing;
    "Landmark" landmark: seeing;
    "WordRecognized" word_recognized: hearing;
    "SoundLocated" sound_located: hearing;
    "HandTouch" hand_touch: touching;
    "Bumper" bumper: touching;
    "Sonar" sonar: touching;
    "JointPosition" joint_position: moving;
    "PostureChanged" posture_changed: body;
    "Fall" fall: body;
    "Battery" battery: body;
    "Button" button: touching;
    "Tick" tick: body;
    "TimeOfDay" time_of_day: body;
    "Tracker" tracker: moving;
    "SayInput" say_input: acting;
    "SayParameter" say_parameter: acting;
    "Voice" voice: acting;
    "Sound" sound: acting;
    "EyeLedColor" eye_led_color: acting;
    "EyeBrightness" eye_brightness: acting;
    "Lights" lights: acting;
    "SetJointPosition" set_joint_position: moving;
    "Animation" animation: moving;
    "Behavior" behavior: moving;
    "Posture" posture: body;
    "Walk" walk: moving;
    "RememberFace" remember_face: acting;
    "Print" print: acting;
    "Tablet" tablet: acting;
}

#[test]
fn every_device_of_the_catalogue_has_a_scenario() {
    let catalogue: Vec<&str> = robot::sensors().chain(robot::actuators()).map(|device| device.name).collect();
    assert_eq!(TRIED, catalogue);
}
