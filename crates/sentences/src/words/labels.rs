//! What senses and actions are called in each language; in English as the catalogue says.

use crate::Language;

/// By the name in files.
const JAPANESE: &[(&str, &str)] = &[
    ("RedBall", "赤いボール"),
    ("FaceDetection", "顔"),
    ("HeadTouch", "頭のタッチ"),
    ("ColorBall", "色のボール"),
    ("Blob", "色のもの"),
    ("People", "人"),
    ("Landmark", "マーク"),
    ("WordRecognized", "言葉"),
    ("SoundLocated", "大きな音"),
    ("HandTouch", "手のタッチ"),
    ("Bumper", "バンパー"),
    ("Sonar", "前の距離"),
    ("JointPosition", "関節"),
    ("PostureChanged", "姿勢"),
    ("Fall", "転倒"),
    ("Battery", "バッテリー"),
    ("Button", "ボタン"),
    ("Tick", "時計"),
    ("TimeOfDay", "時刻"),
    ("Tracker", "トラッカー"),
    ("SayInput", "値を言う"),
    ("SayParameter", "文を言う"),
    ("Voice", "話し方"),
    ("Sound", "音"),
    ("EyeLedColor", "目の色"),
    ("EyeBrightness", "目の明るさ"),
    ("Lights", "ほかのライト"),
    ("SetJointPosition", "関節を動かす"),
    ("Animation", "身ぶり"),
    ("Behavior", "ロボットのビヘイビア"),
    ("Posture", "姿勢をとる"),
    ("Walk", "歩く"),
    ("RememberFace", "顔を覚える"),
    ("Print", "値を表示"),
    ("Tablet", "Pepper のタブレット"),
];

/// What a sense or an action of the catalogue is called: `RedBall` is *Red ball*. None if it is not known.
#[must_use]
pub fn device_label(name: &str, language: Language) -> Option<&'static str> {
    match language {
        Language::English => {
            let device = robot::sensors().chain(robot::actuators()).find(|device| device.name == name);
            device.map(|device| device.label)
        }
        Language::Japanese => JAPANESE.iter().find(|label| label.0 == name).map(|label| label.1),
    }
}
