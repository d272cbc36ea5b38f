//! Tells the page which languages there are: the codes of the catalogues beside it, such as `static/ja.txt`.

use crate::dist::DistFiles;
use crate::tools::ToolResult;

const PAGE: &str = "index.html";
/// The attribute in which `boot.js` finds the codes, with spaces between.
const NAMED: &str = "data-languages=\"\"";

/// Writes the codes of all catalogues into the page.
pub(crate) fn name(mut statics: DistFiles) -> ToolResult<DistFiles> {
    let codes: Vec<&str> = statics.iter().filter_map(|(name, text)| code(name, text)).collect();
    let named = NAMED.replace("\"\"", &format!("\"{}\"", codes.join(" ")));
    let page = statics.get(PAGE).and_then(|page| std::str::from_utf8(page).ok()).unwrap_or_default();
    if page.matches(NAMED).count() != 1 {
        return Err(format!("static/{PAGE} has no place for the languages; write `{NAMED}` once."));
    }
    let page = page.replace(NAMED, &named);
    statics.insert(PAGE.to_owned(), page.into_bytes());
    Ok(statics)
}

/// The code of a catalogue, which its name and its first line tell; none if the file is another one.
fn code<'n>(name: &'n str, text: &[u8]) -> Option<&'n str> {
    let code = name.strip_suffix(".txt")?;
    text.strip_prefix(format!("# {code}\n").as_bytes()).map(|_| code)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::dist;

    type Tested = Result<(), Box<dyn std::error::Error>>;

    #[test]
    fn the_page_is_told_of_every_catalogue_and_a_third_one_is_a_file() -> Tested {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut statics = dist::read(&folder.join("../../static"))?;
        let page = |statics: &DistFiles| String::from_utf8_lossy(&statics[PAGE]).into_owned();
        assert!(page(&name(statics.clone())?).contains(" data-languages=\"ja\""));
        statics.insert("de.txt".to_owned(), std::fs::read(folder.join("../../tests/languages/de.txt"))?);
        assert!(page(&name(statics)?).contains(" data-languages=\"de ja\""));
        Ok(())
    }

    #[test]
    fn a_page_without_a_place_for_them_stops_the_build() {
        let statics = DistFiles::from([(PAGE.to_owned(), b"<html>".to_vec())]);
        assert!(name(statics).is_err_and(|sentence| sentence.contains("static/index.html")));
    }
}
