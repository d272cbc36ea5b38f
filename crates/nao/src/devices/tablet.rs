//! The tablet of a Pepper. A text is a page of its own without scripts or links, a picture is one of the robot: nothing is
//! fetched from elsewhere.
//!
//! The robot's own address on the tablet, and that it shows a page that is written into its address, are as people have them
//! in public programs; neither was tried on a robot here.

use super::{NaoDriver, OpenActuator, OpenDevice};
use crate::deed::{Action, ServiceCall};
use behaviour::Value;
use robot::RobotFault;
use std::fmt::Write;

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Tablet",
    services: &["ALTabletService"],
    joints: &[],
    open: |chosen| {
        OpenDevice::act(match chosen.text("shows")? {
            "picture" => Tablet::Picture(picture(chosen.text("picture")?)?),
            "value" => Tablet::Value,
            _ => Tablet::Text(chosen.text("text")?.to_owned()),
        })
    },
};

/// Where the tablet finds what is in the folder of applications of the robot.
const APPS: &str = "http://198.18.0.1/apps/";
/// Longest text in characters.
const TEXT_MAX_CHARS: usize = 200;

/// The things that the tablet can show.
enum Tablet {
    Text(String),
    Value,
    /// The picture at this address.
    Picture(String),
}

/// The address of a picture by its path among the applications, as `my-pictures/cat.png`; none for what leads elsewhere.
fn picture(path: &str) -> Option<String> {
    let path = path.trim().trim_start_matches('/');
    let parts: Vec<&str> = path.split('/').collect();
    let is_odd = |part: &&str| part.is_empty() || part.starts_with('.');
    if parts.iter().any(is_odd) {
        return None;
    }
    let parts: Vec<String> = parts.into_iter().map(encoded).collect();
    Some(format!("{APPS}{}", parts.join("/")))
}

/// A text as it may stand in an address: all but letters and digits of English as their bytes.
fn encoded(text: &str) -> String {
    text.bytes().fold(String::new(), |mut made, byte| {
        if byte.is_ascii_alphanumeric() || b"-_.".contains(&byte) {
            made.push(char::from(byte));
        } else {
            let _never_fails = write!(made, "%{byte:02X}");
        }
        made
    })
}

/// A page with a large text, and nothing else.
fn page(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let style = "margin:0;height:100vh;display:flex;align-items:center;justify-content:center;font:bold 72px sans-serif;\
                 text-align:center";
    format!("data:text/html;charset=utf-8,{}", encoded(&format!("<body style=\"{style}\">{text}")))
}

impl OpenActuator for Tablet {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let text = match self {
            Self::Picture(address) => {
                return Ok(Action::Tablet(ServiceCall::new("ALTabletService", "showImage", [address.as_str().into()])));
            }
            Self::Text(text) => text.clone(),
            Self::Value => value.as_text().map_or_else(|| value.to_string(), str::to_owned),
        };
        let text: String = text.chars().take(TEXT_MAX_CHARS).collect();
        Ok(Action::Tablet(ServiceCall::new("ALTabletService", "showWebview", [page(&text).as_str().into()])))
    }
}

#[cfg(test)]
mod tests {
    use super::{page, picture};

    #[test]
    fn a_picture_is_one_of_the_robot() {
        assert_eq!(picture(" ours/a cat.png").as_deref(), Some("http://198.18.0.1/apps/ours/a%20cat.png"));
        for odd in ["", "..", "ours/../../etc/passwd", "ours//cat.png", ".hidden/cat.png"] {
            assert_eq!(picture(odd), None, "{odd}");
        }
        let elsewhere = picture("http:example.org/cat.png").unwrap_or_default();
        assert!(elsewhere.starts_with("http://198.18.0.1/apps/http%3A"), "{elsewhere}");
    }

    #[test]
    fn a_text_is_no_page_of_its_own() {
        let page = page("<script>x</script>");
        let shown = page.split("%3E").nth(1).unwrap_or_default();
        assert!(shown.starts_with("%26lt%3Bscript%26gt%3B") && !page.contains("<"), "{page}");
    }
}
