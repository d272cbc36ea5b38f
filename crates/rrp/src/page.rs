//! The page that this program carries: part of it where it is optimised, read from disk as it is then otherwise.

use rust_embed::RustEmbed;
use server::PageFile;

#[derive(RustEmbed)]
#[folder = "$RRP_PAGE_DIR"]
struct EmbeddedFiles;

/// The page's file of a name.
pub(crate) fn page(name: &str) -> Option<PageFile> {
    EmbeddedFiles::get(name).map(|file| PageFile { hash: file.metadata.sha256_hash(), data: file.data })
}
