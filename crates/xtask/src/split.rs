//! Cuts the page's code into pieces: what is needed first, and what `frontend/src/pieces.rs` fetches after that.

use std::fmt::Display;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

use wasm_encoder::reencode::{Reencode, RoundtripReencoder};
use wasm_encoder::{ImportSection, Module, RawSection};
use wasm_split_cli_support::Options;
use wasmparser::{Parser, Payload};

use crate::dist::{self, DistFiles, PIECES, is_later};
use crate::tools::ToolResult;

/// The flags by which the linker leaves in the code what is needed to cut it.
pub(crate) const FLAGS: &str = "-C link-args=--emit-relocs";

/// The module that the code imports its loader from, until that is a part of the page's own module.
const LINK: &str = "./later.js";
const MAIN: &str = "main.wasm";
/// The beginning of the names of later pieces, as they are cut; behind it is the word in the attribute in
/// `frontend/src/pieces.rs`.
const CUT: &str = "split_";
/// The beginning of the names of what several of them have in common, which comes with the first of those.
const COMMON: &str = "chunk_";

/// Marks functions in whose place wasm-bindgen puts an import. They have to stay in the first piece; what cuts the code
/// knows the mark by the name only that it had in older versions of wasm-bindgen.
const MARK: &str = "__wbindgen_describe_generic_import";
const OLD_MARK: &str = "__wbindgen_describe_cast";

/// The page's code in pieces.
pub(crate) struct PagePieces {
    /// The module that is loaded first; wasm-bindgen has yet to see it.
    pub(crate) first: Vec<u8>,
    /// The files that are loaded later, by their names.
    pub(crate) later: DistFiles,
    /// The JavaScript that loads them.
    loader: String,
}

/// Cuts `code`, which was linked with `FLAGS`, into pieces for the page's own `module`. `folder` is for what comes about on
/// the way.
pub(crate) fn cut(folder: &Path, code: &[u8], module: &str) -> ToolResult<PagePieces> {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| format!("{} cannot be emptied: {error}.", folder.display()))?;
    }
    let (main, main_module) = (folder.join(MAIN), format!("./{module}"));
    let code = with_import_renamed(code, MARK, OLD_MARK)?;
    let mut options = Options::new(&code);
    options.output_dir = folder;
    options.main_out_path = &main;
    options.link_name = LINK;
    options.main_module = &main_module;
    let cut = wasm_split_cli_support::transform(options);
    cut.map_err(|error| format!("The page could not be cut in two: {error:#}."))?;
    let mut files = dist::read(folder)?;
    let mut take = |name: &str| files.remove(name).ok_or_else(|| format!("The page was cut without {name}."));
    let first = with_import_renamed(&take(MAIN)?, OLD_MARK, MARK)?;
    let loader = take(LINK.trim_start_matches("./"))?;
    let loader = String::from_utf8(loader).map_err(|error| format!("The loader is no text: {error}."))?;
    let loader = without_import(&loader, &main_module)?;
    named_by_content(PagePieces { first, later: files, loader })
}

/// Code in which an import has another name.
fn with_import_renamed(code: &[u8], from: &str, to: &str) -> ToolResult<Vec<u8>> {
    let trouble = |error: &dyn Display| format!("The page's imports could not be renamed: {error}.");
    let mut module = Module::new();
    for payload in Parser::new(0).parse_all(code) {
        let payload = payload.map_err(|error| trouble(&error))?;
        if let Payload::ImportSection(imports) = payload {
            let mut section = ImportSection::new();
            for import in imports.into_imports() {
                let import = import.map_err(|error| trouble(&error))?;
                let kind = RoundtripReencoder.entity_type(import.ty).map_err(|error| trouble(&error))?;
                section.import(import.module, if import.name == from { to } else { import.name }, kind);
            }
            module.section(&section);
        } else if let Some((id, range)) = payload.as_section() {
            module.section(&RawSection { id, data: &code[range] });
        }
    }
    Ok(module.finish())
}

/// The loader as a part of the page's own module, from which it need not import anything then.
fn without_import(loader: &str, main_module: &str) -> ToolResult<String> {
    let import = format!("import {{ initSync }} from \"{main_module}\";\n");
    let rest = loader.strip_prefix(&import).ok_or("The loader does not begin with its import.")?;
    Ok(rest.to_owned())
}

/// A page that is older than the server must never get a piece that does not fit it: the name of each says what is in all.
fn named_by_content(mut pieces: PagePieces) -> ToolResult<PagePieces> {
    let mut hasher = DefaultHasher::new();
    (&pieces.first, &pieces.later).hash(&mut hasher);
    let (all, mut later) = (hasher.finish(), DistFiles::new());
    for (name, code) in pieces.later {
        let stem = name.strip_suffix(".wasm").unwrap_or_default();
        let common = stem.strip_prefix(COMMON).map(|number| format!("common-{number}"));
        let stem = stem.strip_prefix(CUT).map(str::to_owned).or(common);
        let named = stem.map(|stem| format!("{stem}-{all:016x}.wasm")).filter(|named| is_later(named));
        let known = PIECES.join(", ");
        let named = named
            .ok_or_else(|| format!("{name} is no piece that comes later; its name begins with none of {known}."))?;
        pieces.loader = pieces.loader.replace(&format!("./{name}"), &format!("./{named}"));
        later.insert(named, code);
    }
    Ok(PagePieces { later, ..pieces })
}

impl PagePieces {
    /// The module that wasm-bindgen made of the first piece, with the loader inside: one file less to wait for.
    pub(crate) fn with_loader(&self, module: &str) -> ToolResult<String> {
        let from = format!(" from \"{LINK}\"");
        // Once for each piece.
        let is_import = |line: &&str| line.starts_with("import * as ") && line.contains(&from);
        let (imports, lines): (Vec<&str>, Vec<&str>) = module.lines().partition(is_import);
        if imports.is_empty() {
            return Err("The page's module does not import the loader of what comes later.".to_owned());
        }
        let loader = self.loader.replace("export const ", "const ");
        let given = exported(&self.loader).collect::<Vec<_>>().join(", ");
        let name =
            |line: &str| line.trim_start_matches("import * as ").split(' ').next().unwrap_or_default().to_owned();
        let named: String = imports.iter().map(|line| format!("const {} = {{ {given} }};\n", name(line))).collect();
        Ok(format!("{}\n{loader}{named}", lines.join("\n")))
    }
}

/// The names that a module exports.
fn exported(module: &str) -> impl Iterator<Item = &str> {
    let names = module.lines().filter_map(|line| line.strip_prefix("export const "));
    names.filter_map(|line| line.split(' ').next())
}

#[cfg(test)]
mod tests {
    use super::*;
    use wasm_encoder::{CustomSection, EntityType, TypeSection};

    type Tested = Result<(), Box<dyn std::error::Error>>;

    /// A module that imports two functions and has something else behind that.
    fn module() -> Vec<u8> {
        let (mut types, mut imports) = (TypeSection::new(), ImportSection::new());
        types.ty().function([], []);
        imports.import("a", MARK, EntityType::Function(0)).import("a", "other", EntityType::Function(0));
        let other = CustomSection { name: "other".into(), data: (&[1, 2, 3]).into() };
        let mut module = Module::new();
        module.section(&types).section(&imports).section(&other);
        module.finish()
    }

    fn pieces(first: &[u8]) -> PagePieces {
        let loader = "const load = makeLoad(\"./split_later.wasm\");\nexport const load_later = load;\n".to_owned();
        PagePieces { first: first.to_vec(), later: DistFiles::from([("split_later.wasm".to_owned(), vec![1])]), loader }
    }

    #[test]
    fn a_renamed_import_is_all_that_changes_and_comes_back() -> Tested {
        let before = module();
        let renamed = with_import_renamed(&before, MARK, OLD_MARK)?;
        let has = |code: &[u8], name: &str| code.windows(name.len()).any(|part| part == name.as_bytes());
        assert!(has(&renamed, OLD_MARK) && !has(&renamed, MARK) && has(&renamed, "other"));
        assert_eq!(with_import_renamed(&renamed, OLD_MARK, MARK)?, before);
        Ok(())
    }

    #[test]
    fn the_name_of_a_later_piece_follows_all_of_the_code() -> Tested {
        let (one, other) = (named_by_content(pieces(b"one"))?, named_by_content(pieces(b"other"))?);
        let name = one.later.keys().next().ok_or("no piece")?;
        assert!(is_later(name) && name.ends_with(".wasm") && one.loader.contains(&format!("\"./{name}\"")));
        assert!(!other.later.contains_key(name));
        let mut common = pieces(b"one");
        common.later.insert("chunk_1.wasm".to_owned(), vec![2]);
        common.loader.push_str("const __chunk_1 = makeLoad(\"./chunk_1.wasm\");\n");
        let common = named_by_content(common)?;
        let shared = common.later.keys().find(|name| name.starts_with("common-1-")).ok_or("no common piece")?;
        assert!(is_later(shared) && common.loader.contains(&format!("\"./{shared}\"")));
        let mut unknown = pieces(b"one");
        unknown.later.insert("split_elsewhere.wasm".to_owned(), vec![2]);
        assert!(named_by_content(unknown).is_err_and(|sentence| sentence.contains("split_elsewhere.wasm")));
        Ok(())
    }

    #[test]
    fn the_loader_is_a_part_of_the_module() -> Tested {
        let module = format!("import * as import1 from \"{LINK}\"\nuse(import1);\n");
        let whole = pieces(b"one").with_loader(&module)?;
        assert!(!whole.contains("import *") && !whole.contains("export"));
        assert!(whole.starts_with("use(import1);\n") && whole.ends_with("const import1 = { load_later };\n"));
        let twice = format!("import * as import2 from \"{LINK}\"\n{module}");
        let whole = pieces(b"one").with_loader(&twice)?;
        assert!(!whole.contains("import *"), "each piece imports the loader once more");
        assert!(whole.contains("const import1 = { load_later };") && whole.contains("const import2 = { load_later };"));
        assert!(pieces(b"one").with_loader("use(nothing);").is_err());
        let loader = without_import("import { initSync } from \"./app.js\";\nlet rest;\n", "./app.js")?;
        assert_eq!(loader, "let rest;\n");
        assert!(without_import("let rest;\n", "./app.js").is_err());
        Ok(())
    }
}
