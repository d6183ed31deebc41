//! Test programs: the project's kernels, fixtures, and random ones.

use crate::generate::{self, Layout};
use crate::random::Random;
use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::texture::TextureKind;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, PoisonError};

pub(crate) const PIXEL: [Version; 7] =
    [Version::Ps1_1, Version::Ps1_2, Version::Ps1_3, Version::Ps1_4, Version::Ps2_0, Version::Ps2A, Version::Ps2B];
pub(crate) const FORMATS: &str = "fp32 s3.12 fp16 fp24 s1.10 s3.12:rtz fp16:rtz:nv s7.16 fp32:ftz e4m3 n3.8:rna \
                                  n2.6:rdn s3.12:rup fp16:rod e4m3fn e5m2fnuz:rup e3m2fn";

pub(crate) fn ideal(format: &str) -> Profile {
    static KNOWN: LazyLock<Mutex<BTreeMap<String, Profile>>> = LazyLock::new(Mutex::default);
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let profile = known.entry(format.to_owned()).or_insert_with(|| {
        let mut profile = Profile::named("ideal-fp32").unwrap_or_else(|e| panic!("{e}"));
        let set = format.parse().and_then(|format| profile.set_format(format));
        set.unwrap_or_else(|e| panic!("{format}: {e}"));
        profile
    });
    profile.clone()
}

fn build(text: &str, profile: &Profile) -> Option<CheckedProgram> {
    refsim::check::check(refsim::asm::assemble(text).ok()?, profile).ok()
}

fn walk(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap_or_else(|e| panic!("{e}")).path();
        if path.is_dir() {
            walk(&path, out);
        } else if path.extension().is_some_and(|e| e == "psa" || e == "vsa") {
            out.push(path);
        }
    }
}

/// Every program below `src` and `fixtures` that an ideal device accepts, with its path.
pub(crate) fn files(profile: &Profile) -> Vec<(String, CheckedProgram)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut paths = Vec::new();
    walk(&root.join("src"), &mut paths);
    let kernels = paths.len();
    walk(&root.join("fixtures"), &mut paths);
    paths.sort();
    let mut out = Vec::new();
    for path in &paths {
        let Ok(text) = fs::read_to_string(path) else { continue };
        if let Some(program) = build(&text, profile) {
            out.push((path.display().to_string(), program));
        }
    }
    assert!(kernels > 0 && out.len() > 20, "{} of {} programs pass the checker", out.len(), paths.len());
    out
}

/// A random legal program of at most size class `size` (0 to 3).
pub(crate) fn random(version: Version, size: usize, profile: &Profile, r: &mut Random) -> (String, CheckedProgram) {
    let samplers = [TextureKind::D2, TextureKind::Cube, TextureKind::D2, TextureKind::Volume];
    let layout = Layout { samplers: samplers.into_iter().enumerate().collect(), targets: 4, sampling: r.one_in(4) };
    for _ in 0..4000 {
        let text = generate::program(version, &layout, profile, r.below(size + 1), r).join("\n");
        if let Some(program) = build(&text, profile) {
            return (text, program);
        }
    }
    panic!("no legal {version} program in 4000 tries");
}
