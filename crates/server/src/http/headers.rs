//! What every answer tells the browser about how far to trust it.

/// The headers of every answer, but for those that [`is_needed`] leaves out.
pub(super) const HEADERS: [(&str, &str); 5] = [
    (
        "content-security-policy",
        "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; img-src 'self' data:; \
         style-src 'self'; font-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'self'; \
         frame-ancestors 'none'",
    ),
    ("x-content-type-options", "nosniff"),
    // With less, browsers would keep to themselves from which page a form is sent, as that of Stop is without script.
    ("referrer-policy", "same-origin"),
    ("cross-origin-opener-policy", "same-origin"),
    ("permissions-policy", "camera=(), microphone=(), geolocation=()"),
];

/// The headers that say something about a document only, which a script, a sheet or a program in it never is.
const OF_DOCUMENTS: [&str; 3] = ["content-security-policy", "cross-origin-opener-policy", "permissions-policy"];
/// The types of answers that are only ever a part of a document. Opened by themselves they are shown as text, or kept.
const PARTS: [&str; 3] = ["application/wasm", "text/css", "text/javascript"];

/// True if an answer of this type is to have this header. The first load is half a kilobyte smaller for each that is left out of
/// a file of the page.
pub(super) fn is_needed(header: &str, content_type: Option<&str>) -> bool {
    let kind = content_type.and_then(|kind| kind.split(';').next()).unwrap_or_default();
    !(OF_DOCUMENTS.contains(&header) && PARTS.contains(&kind))
}

#[cfg(test)]
mod tests {
    use super::{HEADERS, OF_DOCUMENTS, is_needed};

    #[test]
    fn only_parts_of_a_document_go_without_what_is_about_documents() {
        assert!(OF_DOCUMENTS.iter().all(|header| HEADERS.iter().any(|(known, _)| known == header)));
        for (header, _) in HEADERS {
            for whole in [None, Some("text/html; charset=utf-8"), Some("image/svg+xml"), Some("text/plain"), Some("")] {
                assert!(is_needed(header, whole), "{header} of {whole:?}");
            }
            let of_script = is_needed(header, Some("text/javascript; charset=utf-8"));
            assert_eq!(of_script, ["x-content-type-options", "referrer-policy"].contains(&header), "{header}");
        }
    }
}
