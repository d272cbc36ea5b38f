//! What who comes by a link is prepared for: the warning of their browser, step by step, and what to compare.

use super::making::OneOf;
use crate::browser;
use crate::people::words::{self, WarnedDevice};
use leptos::prelude::*;

/// The steps for one device, and the fingerprint; both may be sent along with the link.
#[component]
pub(super) fn Warning(link: String, fingerprint: String) -> impl IntoView {
    let (device, copied) = (RwSignal::new(WarnedDevice::AppleTouch), RwSignal::new(None::<WarnedDevice>));
    let host = host_of(&link).to_owned();
    let steps = {
        let host = host.clone();
        move || {
            let steps = words::warning_steps(device.get(), &host);
            steps.into_iter().map(|step| view! { <li>{step}</li> }).collect_view()
        }
    };
    let copy = {
        let fingerprint = fingerprint.clone();
        move |_| {
            let chosen = device.get_untracked();
            let message = words::warning_message(chosen, &link, &host, &fingerprint);
            copied.set(browser::copy(&message).then_some(chosen));
        }
    };
    let is_copied = move || copied.get() == Some(device.get());
    view! {
        <section class="warning" aria-label=words::warning_title()>
            <p>{words::warning_title()}</p>
            <OneOf label=words::warning_device() name="invite-device" options=WarnedDevice::ALL.map(|one| (one, words::device_named(one)))
                value=device />
            <ol>{steps}</ol>
            <p class="second">{words::fingerprint_of()}" "<code>{fingerprint}</code></p>
            <p class="second">{words::fingerprint_compare()}</p>
            <button class="button" type="button" on:click=copy>
                {move || if is_copied() { words::link_copied() } else { words::copy_message() }}
            </button>
        </section>
    }
}

/// `192.168.1.5:7130` of its link.
fn host_of(link: &str) -> &str {
    let host = link.split_once("://").map_or(link, |(_, rest)| rest);
    host.split(['/', '#']).next().unwrap_or(host)
}

#[cfg(test)]
mod tests {
    use super::host_of;

    #[test]
    fn a_link_leads_to_a_host() {
        assert_eq!(host_of("https://192.168.1.5:7130/come-in#abc"), "192.168.1.5:7130");
        assert_eq!(host_of("https://[::1]:7130/come-in#abc"), "[::1]:7130");
    }
}
