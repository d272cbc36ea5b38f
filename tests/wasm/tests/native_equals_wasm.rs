//! The same story gives the same bits natively and as WebAssembly: this package builds itself for wasm32 and runs the
//! module in an interpreter written in Rust, so no browser and no network is needed.
#![cfg(not(target_family = "wasm"))]

use house_wasm::runs::{FIXED, said};
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;
use wasmi::{CompilationMode, Config, Engine, Instance, Linker, Module, Store, TypedFunc};

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

fn instance(module: &[u8]) -> (Store<()>, Instance) {
    // Most of the module is never called, so only what is called is translated.
    let engine = Engine::new(Config::default().compilation_mode(CompilationMode::Lazy));
    let module = Module::new(&engine, module).expect("the module is valid");
    assert_eq!(module.imports().count(), 0, "pure rooms ask nothing of their host");
    let mut store = Store::new(&engine, ());
    let instance = Linker::new(&engine).instantiate_and_start(&mut store, &module).expect("it starts");
    (store, instance)
}

/// The module, built once.
fn built() -> &'static [u8] {
    static MODULE: OnceLock<Vec<u8>> = OnceLock::new();
    MODULE.get_or_init(module)
}

#[test]
fn native_and_wasm_compute_the_same_bits() {
    let (mut store, instance) = instance(built());
    let in_wasm: TypedFunc<(u64, u32), u64> =
        instance.get_typed_func(&store, "simulation_hash").expect("it is exported");
    for seed in [1, 2, 0xdead_beef_dead_beef] {
        let native = house_wasm::simulation_hash(seed, STEPS);
        assert_eq!(native, house_wasm::simulation_hash(seed, STEPS), "natively it repeats, seed {seed}");
        let wasm = in_wasm.call(&mut store, (seed, STEPS)).expect("it runs");
        assert_eq!(native, wasm, "seed {seed}");
    }
}

/// Random behaviours that are run, after the fixed ones.
const RANDOM: u32 = 60;

#[test]
fn native_and_wasm_run_behaviours_to_the_same_bytes() {
    let (mut store, instance) = instance(built());
    let says: TypedFunc<(u32, u32), u64> = instance.get_typed_func(&store, "engine_says").expect("it is exported");
    let memory = instance.get_memory(&store, "memory").expect("it has a memory");
    let mut bytes = 0;
    for (case, frame_ms) in (0..FIXED + RANDOM).flat_map(|case| [(case, 0), (case, 50)]) {
        let native = said(case, frame_ms);
        let place = says.call(&mut store, (case, frame_ms)).expect("it runs");
        let (start, length) = ((place >> 32) as usize, (place & 0xffff_ffff) as usize);
        let wasm = &memory.data(&store)[start..start + length];
        assert_eq!(text(wasm), text(&native), "case {case}, frames of {frame_ms} ms");
        assert!(case >= FIXED || !native.is_empty(), "case {case} says something");
        bytes += native.len();
    }
    assert!(bytes > 100_000, "too little to mean anything: {bytes} bytes");
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("lines of text")
}

#[test]
fn seeds_and_lengths_make_a_difference() {
    let hash = house_wasm::simulation_hash;
    assert_ne!(hash(1, 100), hash(2, 100));
    assert_ne!(hash(1, 100), hash(1, 101));
}
