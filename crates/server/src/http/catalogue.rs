//! The page of the catalogue: what robots can sense and do, drawn from the declarations of the devices.

use axum::http::header;
use axum::response::{Html, IntoResponse, Response};
use robot::{Device, Param, Robot, actuators, sensors};
use simulation::SimulatedNao;
use std::fmt::Write;
use std::sync::LazyLock;

const STYLE: &str = include_str!("catalogue/page.css");
/// It is the same as long as the server runs.
static PAGE: LazyLock<String> = LazyLock::new(page_of_all);

/// The page.
pub(super) fn page() -> Response {
    Html(PAGE.as_str()).into_response()
}

/// How it looks.
pub(super) fn style() -> Response {
    ([(header::CONTENT_TYPE, "text/css; charset=utf-8")], STYLE).into_response()
}

fn page_of_all() -> String {
    let mut page = String::from(
        "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
         <title>Senses and actions</title><link rel=\"stylesheet\" href=\"/catalogue.css\"></head><body><main>\
         <h1>Senses and actions</h1>\
         <p>What a robot can notice, and what it can do. Angles are in radians, lengths in metres. In pictures x is to \
         the side, left positive, and y is down.</p>",
    );
    let simulated = SimulatedNao::new(0).devices();
    section(&mut page, "Senses", sensors(), &simulated);
    section(&mut page, "Actions", actuators(), &simulated);
    page.push_str("</main></body></html>");
    page
}

fn section(to: &mut String, title: &str, devices: impl Iterator<Item = &'static Device>, simulated: &[&str]) {
    let _ = write!(to, "<h2>{title}</h2>");
    for device in devices {
        let (name, says) = (device.name, escaped(device.says));
        let _ = write!(to, "<section id=\"{name}\"><h3>{name}</h3><p>{says}</p><dl>");
        device.params.iter().for_each(|param| setting(to, param));
        value(to, device);
        let _ = write!(to, "<dt>Example</dt><dd><code>{}</code></dd>", escaped(device.example));
        let _ = write!(to, "<dt>Robots</dt><dd>{}</dd></dl></section>", robots_with(name, simulated));
    }
}

fn setting(to: &mut String, param: &Param) {
    let _ = write!(to, "<dt>{}</dt><dd>{}</dd>", escaped(param.label), escaped(&param.range_words()));
}

fn value(to: &mut String, device: &Device) {
    let fields = device.shape.fields();
    let _ = write!(to, "<dt>Value</dt><dd>");
    if fields.is_empty() {
        to.push_str(&escaped(&device.value_words()));
    }
    for field in fields {
        let _ = write!(to, "<p><code>{}</code> {}</p>", field.name, escaped(field.says));
    }
    to.push_str("</dd>");
}

/// Which robots have it.
fn robots_with(name: &str, simulated: &[&str]) -> String {
    let of_nao = nao::MODELS.iter().filter(|model| !model.lacks.contains(&name)).map(|model| model.name);
    let simulated = simulated.contains(&name).then_some("simulated NAO");
    of_nao.chain(simulated).collect::<Vec<_>>().join(", ")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::page_of_all;
    use robot::{actuators, sensors};

    #[test]
    fn every_device_is_on_the_page_with_all_that_can_be_set() {
        let page = page_of_all();
        for device in sensors().chain(actuators()) {
            let from = page.find(&format!("<section id=\"{}\">", device.name)).unwrap();
            let part = &page[from..from + page[from..].find("</section>").unwrap()];
            assert!(device.params.iter().all(|param| part.contains(param.label)), "{part}");
            assert!(device.shape.fields().iter().all(|field| part.contains(field.name)), "{part}");
            assert!(part.contains("<code>"), "{part}");
            assert_eq!(part.contains("simulated NAO"), device.name != "Tablet", "{part}");
            assert!(device.name != "Tablet" || part.contains("<dd>Pepper</dd>"), "{part}");
        }
    }
}
