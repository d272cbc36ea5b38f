//! Finds the folder of the built page, so that the program can carry it: `target/page`, or `RRP_PAGE_DIR`.

use std::path::{Path, PathBuf};

fn main() -> std::io::Result<()> {
    println!("cargo:rerun-if-env-changed=RRP_PAGE_DIR");
    println!("cargo:rerun-if-changed=build.rs");
    let page = std::env::var_os("RRP_PAGE_DIR").map_or_else(|| target().join("page"), PathBuf::from);
    std::fs::create_dir_all(&page)?;
    println!("cargo:rustc-env=RRP_PAGE_DIR={}", page.display());
    // Without optimisation the page is read from disk as it is then; otherwise it is part of the program.
    if std::env::var("PROFILE").as_deref() != Ok("debug") {
        println!("cargo:rerun-if-changed={}", page.display());
    }
    Ok(())
}

/// The target folder: the one that cargo marked as a cache, above this script's own folder.
fn target() -> PathBuf {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_else(|| "target/debug/build/rrp/out".into()));
    let marked = |folder: &&Path| folder.join("CACHEDIR.TAG").is_file();
    let found = out.ancestors().find(marked).or_else(|| out.ancestors().nth(4));
    found.map_or_else(|| PathBuf::from("target"), Path::to_path_buf)
}
