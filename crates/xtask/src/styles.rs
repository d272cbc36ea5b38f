//! The stylesheet of the page: small files, each named after what it dresses, joined into one in a stated order. Those of one
//! view stand beside it in the sources of the page, those of many in `static/styles`.

use crate::dist::DistFiles;
use crate::tools::ToolResult;

/// The folder of the small files among the static files.
const FOLDER: &str = "styles/";
/// The one file that they become, so that the first load is one request for all of them.
const SHEET: &str = "page.css";
/// The sheets of screens whose code comes in a piece of its own, which fetches them; nobody else does.
const APART: [&str; 2] = ["operate.css", "past.css"];
/// The files that stand first, in this order. Of two rules that weigh alike the later one holds: tokens stand before the page from
/// top to bottom. Every file that is named neither here nor below stands after these, by its name: one that dresses a single
/// panel or dialog needs no place.
const FIRST: [&str; 29] = [
    "tokens",
    "base",
    "frame",
    "bar",
    "menus",
    "palette",
    "robot",
    "running",
    "recordings",
    "panels",
    "room",
    "controls",
    "code",
    "dialogs",
    "dialog_parts",
    "library",
    "empty_stage",
    "programs",
    "tags",
    "marbles",
    "teaching",
    "insight",
    "files",
    "outline",
    "notices",
    "conflict",
    "presence",
    "invite",
    "tiles",
];
/// The files that stand last, in this order: what adapts the page to small screens after the page, and the canvas after that.
const LAST: [&str; 22] = [
    "stop",
    "tablet",
    "phone",
    "motion",
    "stage",
    "edges",
    "streams",
    "live_values",
    "chips",
    "people",
    "differs",
    "far",
    "strip",
    "flyout",
    "wires",
    "aside",
    "carried",
    "told",
    "typed",
    "zoom",
    "low",
    "adapted",
];

/// The static files with the stylesheets that stand beside views. `sources` are the sources of the page. A name stands for
/// itself wherever its file is, so no two are alike.
pub(crate) fn with_views(mut statics: DistFiles, sources: DistFiles) -> ToolResult<DistFiles> {
    for (path, sheet) in sources {
        let name = path.rsplit('/').next().unwrap_or_default();
        if name.starts_with('.') || !name.ends_with(".css") {
            continue;
        }
        let name = if APART.contains(&name) { name.to_owned() } else { format!("{FOLDER}{name}") };
        if statics.insert(name, sheet).is_some() {
            return Err(format!("frontend/src/{path} has the name of another stylesheet; rename it."));
        }
    }
    Ok(statics)
}

/// The static files with one stylesheet in place of the small ones.
pub(crate) fn join(mut statics: DistFiles) -> ToolResult<DistFiles> {
    let named: Vec<String> = FIRST.iter().chain(&LAST).map(|name| path(name)).collect();
    let others: Vec<String> =
        statics.keys().filter(|name| name.starts_with(FOLDER) && !named.contains(name)).cloned().collect();
    let (first, last) = named.split_at(FIRST.len());
    let mut sheet = Vec::new();
    for name in first.iter().chain(&others).chain(last) {
        let small =
            statics.remove(name).ok_or_else(|| format!("The stylesheet {name} is missing; styles.rs names it."))?;
        sheet.extend(small);
    }
    if statics.insert(SHEET.to_owned(), sheet).is_some() {
        return Err(format!("static/{SHEET} has the name of what the stylesheets are joined into; rename it."));
    }
    Ok(statics)
}

fn path(name: &str) -> String {
    format!("{FOLDER}{name}.css")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::dist;

    type Tested = Result<(), Box<dyn std::error::Error>>;

    fn all() -> DistFiles {
        FIRST.iter().chain(&LAST).map(|name| (path(name), format!("{name};").into_bytes())).collect()
    }

    fn at(name: &str) -> Option<usize> {
        FIRST.iter().chain(&LAST).position(|known| *known == name)
    }

    #[test]
    fn they_are_joined_in_their_order() -> Tested {
        let joined = join(all())?;
        assert_eq!(joined.len(), 1);
        let text = std::str::from_utf8(&joined[SHEET])?;
        assert!(text.starts_with("tokens;base;frame;"), "{text}");
        assert!(text.ends_with("strip;flyout;wires;aside;carried;told;typed;zoom;low;adapted;"), "{text}");
        Ok(())
    }

    #[test]
    fn what_adapts_the_page_comes_after_it() {
        assert_eq!(at("tokens"), Some(0));
        for adapted in ["frame", "bar", "robot", "dialogs", "library", "notices", "stop"] {
            assert!(at(adapted) < at("tablet") && at(adapted) < at("phone") && at(adapted) < at("motion"));
        }
        assert!(at("menus") < at("strip") && at("frame") < at("stage"), "the canvas has its own menus and stage");
        assert_eq!(at("adapted"), Some(FIRST.len() + LAST.len() - 1));
    }

    #[test]
    fn a_stylesheet_that_is_missing_stops_the_build() {
        let mut missing = all();
        missing.remove("styles/room.css");
        assert!(join(missing).is_err_and(|sentence| sentence.contains("styles/room.css is missing")));
    }

    #[test]
    fn a_stylesheet_that_nobody_names_stands_before_what_adapts_the_page() -> Tested {
        let mut more = all();
        more.extend(["zebra", "ant"].map(|name| (path(name), format!("{name};").into_bytes())));
        let joined = join(more)?;
        let text = std::str::from_utf8(&joined[SHEET])?;
        assert!(text.contains(&format!("{};ant;zebra;{};", FIRST[FIRST.len() - 1], LAST[0])), "{text}");
        Ok(())
    }

    #[test]
    fn a_stylesheet_stands_beside_its_view_or_among_the_static_files_and_not_in_both() -> Tested {
        let one = |name: &str| (name.to_owned(), b"a".to_vec());
        let sources = ["room/room.css", "room.rs", "past/past.css", "room/.room.css"].map(one);
        let all = with_views(DistFiles::new(), sources.clone().into())?;
        assert!(all.keys().eq(["past.css", "styles/room.css"]), "{all:?}");
        assert!(with_views(all, sources.into()).is_err_and(|sentence| sentence.contains("frontend/src/past/past.css")));
        Ok(())
    }

    #[test]
    fn the_page_asks_for_one_stylesheet_made_of_all_that_there_are() -> Tested {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let small = with_views(dist::read(&root.join("static"))?, dist::read(&root.join("frontend/src"))?)?;
        let silent = small.iter().find(|(name, text)| name.starts_with(FOLDER) && !text.starts_with(b"/* "));
        assert!(silent.is_none(), "each opens with a sentence about what it dresses");
        let statics = join(small)?;
        let page = std::str::from_utf8(&statics["index.html"])?;
        assert_eq!(page.matches("rel=\"stylesheet\"").count(), 1);
        assert!(page.contains(&format!("href=\"/{SHEET}\"")));
        assert!(!statics.keys().any(|name| name.ends_with(".css") && name != SHEET && !APART.contains(&name.as_str())));
        Ok(())
    }
}
