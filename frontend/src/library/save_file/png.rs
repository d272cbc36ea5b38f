//! The drawing as a picture: the browser draws the SVG of the server on a canvas and keeps what is there as PNG.

use crate::desk::file_address;
use crate::reasons::NoPicture;
use behaviour::Id;
use js_sys::Promise;
use leptos::prelude::{document, window};
use wasm_bindgen::{JsCast, JsValue, closure::Closure};
use wasm_bindgen_futures::JsFuture;
use web_sys::{CanvasRenderingContext2d, HtmlAnchorElement, HtmlCanvasElement, HtmlImageElement, Response, Url};

/// So many pixels for one of the drawing, if there is room.
const SHARP: f64 = 2.0;
/// The longest side of the picture, in pixels.
const SIDE_MAX_PX: f64 = 8_192.0;
/// How long the browser may take to save the picture before it is forgotten, in milliseconds.
const KEPT_MS: i32 = 60_000;

/// A drawing as the server gives it.
struct ServedDrawing {
    text: String,
    name: String,
}

/// Makes the picture of a program and hands it to the person as a file.
///
/// # Errors
/// Why it could not be made.
pub(super) async fn save_png(id: &Id) -> Result<(), NoPicture> {
    let drawing = drawing(id).await.ok_or(NoPicture::NoDrawing)?;
    let size = size_of(&drawing.text).ok_or(NoPicture::NoDrawing)?;
    let picture = picture(&drawing.text, size).await.ok_or(NoPicture::Refused)?;
    hand_over(&picture, &drawing.name).ok_or(NoPicture::Refused)
}

async fn drawing(id: &Id) -> Option<ServedDrawing> {
    let answer = JsFuture::from(window().fetch_with_str(&file_address(id, "svg"))).await.ok()?;
    let answer: Response = answer.dyn_into().ok()?;
    if !answer.ok() {
        return None;
    }
    let said = answer.headers().get("content-disposition").ok().flatten().unwrap_or_default();
    let text = JsFuture::from(answer.text().ok()?).await.ok()?.as_string()?;
    Some(ServedDrawing { text, name: name_of(&said) })
}

/// The drawing in pixels. It is shown as an image, in which no script runs and nothing else is loaded.
async fn picture(svg: &str, (width, height): (f64, f64)) -> Option<JsValue> {
    let image = HtmlImageElement::new().ok()?;
    let text = String::from(js_sys::encode_uri_component(svg));
    image.set_src(&format!("data:image/svg+xml;charset=utf-8,{text}"));
    JsFuture::from(image.decode()).await.ok()?;
    let canvas: HtmlCanvasElement = document().create_element("canvas").ok()?.dyn_into().ok()?;
    let sharp = sharpness(width, height);
    let (wide, high) = ((width * sharp).round().max(1.0), (height * sharp).round().max(1.0));
    canvas.set_width(wide as u32);
    canvas.set_height(high as u32);
    let pen: CanvasRenderingContext2d = canvas.get_context("2d").ok()??.dyn_into().ok()?;
    pen.draw_image_with_html_image_element_and_dw_and_dh(&image, 0.0, 0.0, wide, high).ok()?;
    JsFuture::from(kept_of(&canvas)).await.ok().filter(JsValue::is_object)
}

/// What stands on a canvas; nothing if the browser does not give it away.
fn kept_of(canvas: &HtmlCanvasElement) -> Promise {
    Promise::new(&mut |yes, no| {
        let then = Closure::once_into_js(move |blob: JsValue| {
            let _ = yes.call1(&JsValue::NULL, &blob);
        });
        if canvas.to_blob(then.unchecked_ref()).is_err() {
            let _ = no.call0(&JsValue::NULL);
        }
    })
}

fn hand_over(picture: &JsValue, name: &str) -> Option<()> {
    let address = Url::create_object_url_with_blob(picture.unchecked_ref()).ok()?;
    let link: HtmlAnchorElement = document().create_element("a").ok()?.dyn_into().ok()?;
    link.set_href(&address);
    link.set_download(name);
    link.click();
    crate::browser::after(KEPT_MS, move || drop(Url::revoke_object_url(&address)));
    Some(())
}

/// How many pixels one of the drawing becomes.
fn sharpness(width: f64, height: f64) -> f64 {
    SHARP.min(SIDE_MAX_PX / width.max(height))
}

/// The width and height that a drawing says of itself in its first element.
fn size_of(svg: &str) -> Option<(f64, f64)> {
    let start = svg.find("<svg")?;
    let element = &svg[start..start + svg[start..].find('>')?];
    let said = |name: &str| {
        let (_, rest) = element.split_once(&format!(" {name}=\""))?;
        rest.split_once('"')?.0.parse::<f64>().ok().filter(|size| size.is_finite() && *size >= 1.0)
    };
    Some((said("width")?, said("height")?))
}

/// The name of the picture, after the one that the server gives the drawing, in its own script.
fn name_of(disposition: &str) -> String {
    let own = disposition.split_once("filename*=UTF-8''").and_then(|(_, rest)| decoded(rest.split(';').next()?.trim()));
    let plain = || Some(disposition.split_once("filename=\"")?.1.split_once('"')?.0.to_owned());
    let name = own.or_else(plain).unwrap_or_default();
    let plain = name.strip_suffix(".svg").unwrap_or(&name);
    if plain.is_empty() { "program.png".to_owned() } else { format!("{plain}.png") }
}

/// A text whose bytes stand there as `%` and their numbers.
fn decoded(text: &str) -> Option<String> {
    let mut parts = text.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    for part in parts {
        bytes.push(u8::from_str_radix(part.get(..2)?, 16).ok()?);
        bytes.extend_from_slice(&part.as_bytes()[2..]);
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::{name_of, sharpness, size_of};

    #[test]
    fn the_size_is_read_of_the_drawing() {
        let svg = "<svg xmlns=\"x\" viewBox=\"-20 0 640 480\" width=\"640\" height=\"480\"><rect width=\"1\"/></svg>";
        assert_eq!(size_of(svg), Some((640.0, 480.0)));
        assert_eq!(size_of("<svg viewBox=\"0 0 1 1\"><rect width=\"9\" height=\"9\"/></svg>"), None);
        assert_eq!([size_of(""), size_of("<svg width=\"0\" height=\"1\">")], [None, None]);
    }

    #[test]
    fn a_picture_is_twice_as_sharp_unless_a_side_would_be_too_long() {
        assert!((sharpness(640.0, 480.0) - 2.0).abs() < 1e-9);
        assert!((sharpness(1_000.0, 16_384.0) * 16_384.0 - 8_192.0).abs() < 1e-9);
    }

    #[test]
    fn it_is_called_like_the_other_files() {
        assert_eq!(name_of("attachment; filename=\"Track-far.svg\""), "Track-far.png");
        let japanese = "attachment; filename=\"program.svg\"; filename*=UTF-8''%E8%BF%91%E3%81%84%20a.svg";
        assert_eq!(name_of(japanese), "近い a.png");
        assert_eq!([name_of(""), name_of("attachment; filename=\".svg\"")], ["program.png"; 2]);
    }
}
