//! The same story gives the same bits natively and as WebAssembly: this package builds itself for wasm32 and runs the
//! module in an interpreter written in Rust, so no browser and no network is needed.
#![cfg(not(target_family = "wasm"))]

use std::path::PathBuf;
use std::process::Command;
use wasmi::{CompilationMode, Config, Engine, Linker, Module, Store, TypedFunc};

/// 10 ms each: ten seconds, with every event of the story.
const STEPS: u32 = 1_000;
const TARGET: &str = "wasm32-unknown-unknown";

/// Builds the module in its own target directory, so that it never waits for the lock of the build that runs it.
fn module() -> Vec<u8> {
    let target = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("wasm");
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    let words = ["build", "--quiet", "--release", "--package", "house-wasm", "--lib", "--target", TARGET];
    cargo.args(words).arg("--target-dir").arg(&target).current_dir(env!("CARGO_MANIFEST_DIR"));
    let ours = |name: &str| name.starts_with("CARGO") || name.starts_with("RUST");
    let kept = |name: &str| matches!(name, "CARGO_HOME" | "RUSTUP_HOME" | "RUSTUP_TOOLCHAIN");
    for (name, _) in std::env::vars().filter(|(name, _)| ours(name) && !kept(name)) {
        cargo.env_remove(name);
    }
    assert!(cargo.status().expect("cargo starts").success(), "the module builds for {TARGET}");
    std::fs::read(target.join(TARGET).join("release/house_wasm.wasm")).expect("the module is there")
}

fn instance(module: &[u8]) -> (Store<()>, TypedFunc<(u64, u32), u64>) {
    // Most of the module is never called, so only what is called is translated.
    let engine = Engine::new(Config::default().compilation_mode(CompilationMode::Lazy));
    let module = Module::new(&engine, module).expect("the module is valid");
    assert_eq!(module.imports().count(), 0, "pure rooms ask nothing of their host");
    let mut store = Store::new(&engine, ());
    let instance = Linker::new(&engine).instantiate_and_start(&mut store, &module).expect("it starts");
    let hash = instance.get_typed_func(&store, "simulation_hash").expect("it is exported");
    (store, hash)
}

#[test]
fn native_and_wasm_compute_the_same_bits() {
    let (mut store, in_wasm) = instance(&module());
    for seed in [1, 2, 0xdead_beef_dead_beef] {
        let native = house_wasm::simulation_hash(seed, STEPS);
        assert_eq!(native, house_wasm::simulation_hash(seed, STEPS), "natively it repeats, seed {seed}");
        let wasm = in_wasm.call(&mut store, (seed, STEPS)).expect("it runs");
        assert_eq!(native, wasm, "seed {seed}");
    }
}

#[test]
fn seeds_and_lengths_make_a_difference() {
    let hash = house_wasm::simulation_hash;
    assert_ne!(hash(1, 100), hash(2, 100));
    assert_ne!(hash(1, 100), hash(1, 101));
}
