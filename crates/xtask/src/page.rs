//! Builds the page: Rust to wasm, wasm to a browser module, static files beside it, all compressed.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

use wasm_bindgen_cli_support::Bindgen;

use crate::dist::{self, DistFiles};
use crate::languages;
use crate::order;
use crate::split;
use crate::styles;
use crate::tools::{self, ToolResult, WASM, Workspace};

/// The package that becomes the page.
const PACKAGE: &str = "frontend";
/// The page's module is `app.js`, its code `app_bg.wasm`.
const NAME: &str = "app";
/// Raised when this program writes something else for the same input.
const FORMAT: u32 = 8;

/// The variable in which cargo reads flags of the compiler for the page, and the flag that keeps the type of a view
/// from growing with all that is in it: a sixth of the page's bytes, and half of the time to compile it.
const FLAGS: &str = "CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS";
const ERASED: &str = "--cfg erase_components";

/// The amount of work that goes into the page.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
pub(crate) enum PageMode {
    /// Optimised and compressed, as people get it.
    Small,
    /// For trying an edit: quick to build, not compressed, with readable stack traces.
    Quick,
}

impl PageMode {
    fn profile(self) -> &'static str {
        match self {
            PageMode::Small => "page",
            PageMode::Quick => "dev",
        }
    }

    /// The folder name that cargo gives to the profile.
    fn folder(self) -> &'static str {
        match self {
            PageMode::Small => "page",
            PageMode::Quick => "debug",
        }
    }
}

/// Builds the page into `target/page`; files that did not change are not touched.
pub(crate) fn build(workspace: &Workspace, mode: PageMode) -> ToolResult<()> {
    tools::ensure_wasm(workspace)?;
    println!("Building the page with the profile `{}`.", mode.profile());
    let wasm = compile(workspace, PACKAGE, mode)?;
    assemble(workspace, &wasm, mode)
}

/// A command that builds the page as people get it.
pub(crate) fn builder() -> ToolResult<Command> {
    let this = env::current_exe().map_err(|error| format!("This program is not found: {error}."))?;
    let mut command = Command::new(this);
    command.arg("page");
    Ok(command)
}

/// Compiles `package` for the browser and answers with its wasm file. Its target folder is its own: the server is compiled
/// at the same time, and holds the lock of the usual one.
fn compile(workspace: &Workspace, package: &str, mode: PageMode) -> ToolResult<PathBuf> {
    let folder = workspace.target.join("page-build");
    let mut cargo = workspace.cargo(&["build", "--lib", "--target", WASM, "--package", package]);
    cargo.args(["--profile", mode.profile(), "--target-dir"]).arg(&folder);
    cargo.env(FLAGS, [ERASED, split::FLAGS].join(" "));
    tools::run(&mut cargo, "Building the page")?;
    let wasm = folder.join(WASM).join(mode.folder()).join(package.replace('-', "_")).with_extension("wasm");
    if !wasm.is_file() {
        return Err(format!("{} was not built; is {package} a cdylib?", wasm.display()));
    }
    Ok(wasm)
}

/// Makes `target/page` out of the wasm file, the folder of static files and the stylesheets, unless it is up to date.
fn assemble(workspace: &Workspace, wasm: &Path, mode: PageMode) -> ToolResult<()> {
    let target = &workspace.target;
    let code = fs::read(wasm).map_err(|error| format!("{} cannot be read: {error}.", wasm.display()))?;
    let mut statics = dist::read(&workspace.root.join("static"))?;
    statics.retain(|name, _| !name.split('/').any(|part| part.starts_with('.')));
    let statics = styles::with_views(statics, dist::read(&workspace.root.join("frontend/src"))?)?;
    let statics = languages::name(styles::join(statics)?)?;
    let stamp = Stamp { file: target.join("page-build/page.stamp"), input: fingerprint(&code, &statics, mode) };
    let page = target.join("page");
    if stamp.holds(&page) {
        println!("The page in {} is up to date.", page.display());
        return Ok(());
    }
    let files = join(bind(target, &code, mode)?, statics)?;
    let changed = dist::write(&page, &files, mode == PageMode::Small)?;
    println!("The page is in {}: {}, {changed} of its files new.", page.display(), dist::sizes(&page)?);
    stamp.save(&page)
}

/// One number for all that the page is made of.
fn fingerprint(code: &[u8], statics: &DistFiles, mode: PageMode) -> u64 {
    let mut hasher = DefaultHasher::new();
    (FORMAT, env!("CARGO_PKG_VERSION"), mode, code, statics).hash(&mut hasher);
    hasher.finish()
}

/// Turns compiled code into a module for the browser, `app.js` and `app_bg.wasm`, and what that fetches later.
fn bind(target: &Path, code: &[u8], mode: PageMode) -> ToolResult<DistFiles> {
    let folder = target.join("page-build/bound");
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(|error| format!("{} cannot be emptied: {error}.", folder.display()))?;
    }
    let module = format!("{NAME}.js");
    let mut pieces = split::cut(&target.join("page-build/cut"), code, &module)?;
    let mut bindgen = Bindgen::new();
    bindgen.input_bytes(NAME, std::mem::take(&mut pieces.first)).typescript(false).out_name(NAME);
    bindgen.remove_name_section(mode == PageMode::Small).remove_producers_section(true);
    // The pieces reach each other by what the linker exports.
    bindgen.keep_lld_exports(true).demangle(false);
    let made = bindgen.web(true).and_then(|bindgen| bindgen.generate(&folder));
    made.map_err(|error| format!("wasm-bindgen could not bind the page: {error:#}."))?;
    let mut files = dist::read(&folder)?;
    let text = files.get(&module).and_then(|text| std::str::from_utf8(text).ok()).unwrap_or_default();
    files.insert(module, pieces.with_loader(text)?.into_bytes());
    files.append(&mut pieces.later);
    if mode == PageMode::Small {
        for (_, code) in files.iter_mut().filter(|(name, _)| name.ends_with(".wasm")) {
            *code = order::alike_together(code)?;
        }
    }
    Ok(files)
}

/// Both sets of files; a static file may not hide a built one.
fn join(mut built: DistFiles, statics: DistFiles) -> ToolResult<DistFiles> {
    for (name, content) in statics {
        if built.insert(name.clone(), content).is_some() {
            return Err(format!("static/{name} has the name of a file that the build makes; rename it."));
        }
    }
    Ok(built)
}

/// Remembers what the page was made of, and what it then consisted of.
struct Stamp {
    file: PathBuf,
    input: u64,
}

impl Stamp {
    /// True if `page` was made of the same input and is still whole.
    fn holds(&self, page: &Path) -> bool {
        let now = dist::listing(page).map(|files| self.words(&files));
        now.is_ok_and(|now| fs::read_to_string(&self.file).is_ok_and(|saved| saved == now))
    }

    fn save(&self, page: &Path) -> ToolResult<()> {
        let words = self.words(&dist::listing(page)?);
        fs::write(&self.file, words).map_err(|error| format!("{} cannot be written: {error}.", self.file.display()))
    }

    fn words(&self, files: &BTreeMap<String, u64>) -> String {
        let lines: Vec<String> = files.iter().map(|(name, bytes)| format!("{bytes} {name}\n")).collect();
        format!("{:016x}\n{}", self.input, lines.concat())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Tested = Result<(), Box<dyn std::error::Error>>;

    #[test]
    fn the_fingerprint_follows_every_input() -> Tested {
        let statics = DistFiles::from([("index.html".to_owned(), b"<p>".to_vec())]);
        let first = fingerprint(b"code", &statics, PageMode::Small);
        assert_eq!(first, fingerprint(b"code", &statics, PageMode::Small));
        assert_ne!(first, fingerprint(b"edoc", &statics, PageMode::Small));
        assert_ne!(first, fingerprint(b"code", &DistFiles::new(), PageMode::Small));
        assert_ne!(first, fingerprint(b"code", &statics, PageMode::Quick));
        Ok(())
    }

    #[test]
    fn a_static_file_may_not_hide_a_built_one() -> Tested {
        let files = DistFiles::from([("app.js".to_owned(), Vec::new())]);
        assert!(join(files.clone(), files).is_err_and(|sentence| sentence.contains("static/app.js")));
        Ok(())
    }

    #[test]
    fn a_stamp_notices_a_lost_file() -> Tested {
        let folder = tempfile::tempdir()?;
        let page = folder.path().join("page");
        let files = DistFiles::from([("a.css".to_owned(), b"a {}".to_vec()), ("b.css".to_owned(), b"b {}".to_vec())]);
        dist::write(&page, &files, false)?;
        let stamp = Stamp { file: folder.path().join("stamp"), input: 7 };
        assert!(!stamp.holds(&page));
        stamp.save(&page)?;
        assert!(stamp.holds(&page));
        fs::remove_file(page.join("a.css"))?;
        assert!(!stamp.holds(&page));
        Ok(())
    }
}
