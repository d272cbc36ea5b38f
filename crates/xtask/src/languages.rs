//! Tells the page which languages there are, by the codes of the catalogues beside it, such as `static/ja.txt`, and writes into
//! it what has to be read in every language before any is chosen.

use crate::dist::DistFiles;
use crate::tools::ToolResult;

const PAGE: &str = "index.html";
/// The attribute in which `boot.js` finds the codes, with spaces between.
const NAMED: &str = "data-languages=\"\"";

/// The comments of the page after whose English the other languages stand, each with the key of the sentence.
const IN_ALL: [(&str, &str); 2] =
    [("<!-- stop.unopened -->", "stop.unopened"), ("<!-- stop.scriptless -->", "stop.scriptless")];

/// Writes into the page the codes of all catalogues, and of each what is read in all languages.
///
/// # Errors
/// The page has no place for them. A catalogue without such a sentence is left out there: English stands above.
pub(crate) fn name(mut statics: DistFiles) -> ToolResult<DistFiles> {
    let catalogues =
        statics.iter().filter_map(|(name, text)| Some((code(name, text)?, std::str::from_utf8(text).ok()?)));
    let catalogues: Vec<(&str, &str)> = catalogues.collect();
    let codes: Vec<&str> = catalogues.iter().map(|(code, _)| *code).collect();
    let named = NAMED.replace("\"\"", &format!("\"{}\"", codes.join(" ")));
    let page = statics.get(PAGE).and_then(|page| std::str::from_utf8(page).ok()).unwrap_or_default();
    if page.matches(NAMED).count() != 1 {
        return Err(format!("static/{PAGE} has no place for the languages; write `{NAMED}` once."));
    }
    let mut page = page.replace(NAMED, &named);
    for (place, key) in IN_ALL {
        let said = catalogues.iter().filter_map(|(code, text)| {
            Some(format!("<br><span lang=\"{code}\">{}</span>", escaped(sentence(text, key)?)))
        });
        let said: String = said.collect();
        if page.matches(place).count() != 1 {
            return Err(format!("static/{PAGE} has no place for {key}; write `{place}` once."));
        }
        page = page.replace(place, &said);
    }
    statics.insert(PAGE.to_owned(), page.into_bytes());
    Ok(statics)
}

/// The code of a catalogue, which its name and its first line tell; none if the file is another one.
fn code<'n>(name: &'n str, text: &[u8]) -> Option<&'n str> {
    let code = name.strip_suffix(".txt")?;
    text.strip_prefix(format!("# {code}\n").as_bytes()).map(|_| code)
}

/// The sentence of a key: the line after the one that is the key.
fn sentence<'t>(catalogue: &'t str, key: &str) -> Option<&'t str> {
    let mut lines = catalogue.lines();
    lines.find(|line| *line == key)?;
    lines.next()
}

/// A sentence as HTML has it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
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
    fn what_is_read_before_a_language_is_chosen_stands_in_all_of_them() -> Tested {
        let places = IN_ALL.map(|(place, _)| place).concat();
        let catalogue =
            |code: &str, said: &str| format!("# {code}\n\nother\nandere\n\nstop.unopened\n{said}\n").into_bytes();
        let statics = DistFiles::from([
            (PAGE.to_owned(), format!("<html {NAMED}><p>English{places}</p>").into_bytes()),
            ("de.txt".to_owned(), catalogue("de", "Öffnet < nicht")),
            ("ja.txt".to_owned(), catalogue("ja", "開きません")),
        ]);
        let page = String::from_utf8(name(statics)?[PAGE].clone())?;
        let all = "English<br><span lang=\"de\">Öffnet &lt; nicht</span><br><span lang=\"ja\">開きません</span></p>";
        assert!(page.ends_with(all), "{page}");
        Ok(())
    }

    #[test]
    fn a_page_without_a_place_for_such_a_sentence_stops_the_build() {
        let statics = DistFiles::from([(PAGE.to_owned(), format!("<html {NAMED}>").into_bytes())]);
        assert!(name(statics).is_err_and(|sentence| sentence.contains("stop.unopened")));
    }

    #[test]
    fn a_page_without_a_place_for_them_stops_the_build() {
        let statics = DistFiles::from([(PAGE.to_owned(), b"<html>".to_vec())]);
        assert!(name(statics).is_err_and(|sentence| sentence.contains("static/index.html")));
    }
}
