//! Every template on the stand-in and on the simulated NAO: what is called, and that both sense and do the same for the same
//! room.

mod balls;
mod case;
mod following;
mod log;
mod people;
mod play;
mod world;

use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn every_template_has_its_test() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/behaviours");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    let tested = [balls::TEMPLATES, following::TEMPLATES, people::TEMPLATES].concat();
    assert_eq!(files, tested.into_iter().map(str::to_owned).collect());
}
