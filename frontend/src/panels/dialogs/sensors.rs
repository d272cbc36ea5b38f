//! Add sensor as a dialog: every sense with what it does.

use super::frame::{Frame, close};
use crate::icons::Icon;
use crate::panels::hold::hold;
use crate::words;
use behaviour::Params;
use leptos::prelude::*;

/// Choosing a sense.
#[component]
pub(super) fn AddSensor() -> impl IntoView {
    let desk = hold();
    let item = move |device: &'static robot::Device| {
        let add = move |_| {
            desk.desk().document.add_sensor(device.name, Params::new());
            close(desk);
        };
        view! {
            <li>
                <button class="menu-item" type="button" on:click=add>
                    <span class="kind sensor"><Icon name=device.icon /></span>
                    <span class="two"><b>{device.name}</b><span class="second">{device.says}</span></span>
                </button>
            </li>
        }
    };
    view! {
        <Frame title=words::add_sensor() narrow=true save=Callback::new(|()| {})>
            <ul class="dialog-body big-list">{robot::sensors().map(item).collect_view()}</ul>
        </Frame>
    }
}
