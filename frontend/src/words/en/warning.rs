//! The warning that browsers give for a certificate which the server made itself, and how to get past it knowingly. What
//! stands in quotation marks is what the browsers write.

use std::fmt::Write;

sentences! {
    warning_title: "Their browser warns once, because this server made its certificate itself. What to press there:";
    warning_device: "Their device";
    fingerprint_of: "SHA-256 fingerprint:";
    fingerprint_compare: "It is this server if all of it is the same. Colons, blanks and capitals do not count. If it differs, close the page and do not go on.";
    copy_message: "Copy the link with these steps";
}

/// What somebody comes with. Each warns in its own words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WarnedDevice {
    AppleTouch,
    Android,
    Windows,
    Mac,
}

impl WarnedDevice {
    /// All of them, the most common one with a robot first.
    pub(crate) const ALL: [Self; 4] = [Self::AppleTouch, Self::Android, Self::Windows, Self::Mac];
}

/// What a device is called.
pub(crate) fn device_named(device: WarnedDevice) -> &'static str {
    match device {
        WarnedDevice::AppleTouch => said!(device_named_ipad_iphone: "iPad, iPhone"),
        WarnedDevice::Android => said!(device_named_android: "Android"),
        WarnedDevice::Windows => said!(device_named_windows: "Windows"),
        WarnedDevice::Mac => said!(device_named_mac: "Mac"),
    }
}

/// What to press there, in order.
pub(crate) fn warning_steps(device: WarnedDevice, host: &str) -> Vec<String> {
    let open =
        said!(warning_steps_open_the_link_a: "Open the link. A warning comes that the connection is not private.")
            .to_owned();
    let compare = match device {
        WarnedDevice::AppleTouch => said!(
            warning_steps_press_show_details_then: "Press “Show Details”, then “view the certificate”, then “More Details”. Compare the fingerprint below, and press “Done”.",
        ),
        WarnedDevice::Mac => said!(
            warning_steps_in_safari_press_show: "In Safari press “Show Details”, then “view the certificate”. Compare the fingerprint below, and press “OK”.",
        ),
        WarnedDevice::Android | WarnedDevice::Windows => said!(
            warning_steps_press_the_sign_left: "Press the sign left of the address, then the line that says the connection is not secure, then the certificate. Compare the fingerprint below.",
        ),
    };
    let go_on = match device {
        WarnedDevice::AppleTouch | WarnedDevice::Mac => {
            said!(warning_steps_press_visit_this_website: "Press “visit this website”, and “Visit Website” once more.")
                .to_owned()
        }
        WarnedDevice::Android => {
            say!(warning_steps_press_advanced_then_proceed: "Press “Advanced”, then “Proceed to {host} (unsafe)”.", host)
        }
        WarnedDevice::Windows => {
            say!(warning_steps_press_advanced_then_continue: "Press “Advanced”, then “Continue to {host} (unsafe)”; Chrome says “Proceed to”.", host)
        }
    };
    vec![
        open,
        compare.to_owned(),
        go_on,
        said!(warning_steps_the_page_of_the: "The page of the invitation says who invites. Press “Come in”.")
            .to_owned(),
    ]
}

/// The link with its steps, as a text to send.
pub(crate) fn warning_message(device: WarnedDevice, link: &str, host: &str, fingerprint: &str) -> String {
    let mut message = format!(
        "{link}\n\n{}\n",
        said!(warning_message: "Your browser warns once, because this server made its certificate itself. What to press:")
    );
    for (at, step) in warning_steps(device, host).iter().enumerate() {
        let _ = writeln!(message, "{}. {step}", at + 1);
    }
    let _ = writeln!(message, "\n{} {fingerprint}\n{}", fingerprint_of(), fingerprint_compare());
    message
}
