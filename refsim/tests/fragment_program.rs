//! OpenGL's fragment programs: facts of the specifications, on the scalar executor.

#[path = "common/running.rs"]
mod running;

use refsim::device::Profile;
use running::run;

#[test]
fn a_program_runs() {
    let nv35 = Profile::named("nv35").unwrap();
    let text =
        "!!FP1.0\nMOVR R0, p[0];\nMADX H1, R0, {0.5}.x, -|p[0]|;\nADDHC R1.xy (GT.x), R0, R0;\nMOVR o[COLR], R1;\nEND";
    let ran = run(text, &nv35, &[[1.0, 2.0, -3.0, 4.0]]);
    assert_eq!(ran.value(0).map(f32::from_bits), [1.0, 2.0, -3.0, 4.0]);
}
