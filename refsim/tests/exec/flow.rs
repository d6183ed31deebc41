//! Tests flow control by lane masks against manually derived results.

use crate::running::{bits, constants, ideal, input, run_quad, run_vertex};
use refsim::exec::{Constants, PixelBindings};
use refsim::raster::FragmentInput;

/// Runs a ps_2_a body on four lanes with t0.x = 0, 1, 2, 3 and returns r0.x of each lane. c0.x = 0, c1.x = 1, c2.x = 2,
/// c3.x = 3; i0 = 3 passes, i1 = 0; b0 true, b1 false.
fn lanes(body: &str) -> [f32; 4] {
    let mut host = constants(&[[0.0; 4], [1.0; 4], [2.0; 4], [3.0; 4]]);
    host.int = vec![[3, 0, 0, 0], [0; 4], [300, 0, 0, 0], [-5, 0, 0, 0]];
    host.boolean = vec![true, false];
    let inputs: [FragmentInput; 4] = std::array::from_fn(|lane| input(&[[lane as f32, 0.0, 0.0, 1.0]]));
    let text = format!("ps_2_a\ndcl t0\nmov r0, c0\nmov r1, t0\n{body}");
    let ran = run_quad(&text, &ideal("e8m23"), &PixelBindings::new(&host), &inputs);
    ran.results.map(|r| f32::from_bits(r.colors[0][0]))
}

const END: &str = "\nmov oC0, r0";

#[test]
fn if_else_by_lane() {
    let body = format!("if_ge r1.x, c2.x\nadd r0, r0, c1\nelse\nadd r0, r0, c3\nendif{END}");
    assert_eq!(lanes(&body), [3.0, 3.0, 1.0, 1.0]);
    let nested = format!(
        "if_lt r1.x, c3.x\nif_eq r1.x, c1.x\nmov r0, c1\nelse\nmov r0, c2\nendif\nadd r0, r0, c1\nelse\nmov r0, c3\nendif{END}"
    );
    assert_eq!(lanes(&nested), [3.0, 2.0, 3.0, 3.0]);
}

#[test]
fn booleans_decide_for_all() {
    assert_eq!(lanes(&format!("if b0\nmov r0, c1\nelse\nmov r0, c2\nendif{END}")), [1.0; 4]);
    assert_eq!(lanes(&format!("if b1\nmov r0, c1\nelse\nmov r0, c2\nendif{END}")), [2.0; 4]);
    assert_eq!(lanes(&format!("if !b1\nmov r0, c1\nendif{END}")), [1.0; 4]);
}

#[test]
fn loops_count_and_break_by_lane() {
    assert_eq!(lanes(&format!("rep i0\nadd r0, r0, c1\nendrep{END}")), [3.0; 4]);
    assert_eq!(lanes(&format!("rep i1\nadd r0, r0, c1\nendrep{END}")), [0.0; 4], "no pass");
    assert_eq!(lanes(&format!("rep i3\nadd r0, r0, c1\nendrep{END}")), [0.0; 4], "a negative count");
    assert_eq!(lanes(&format!("rep i2\nadd r0, r0, c1\nendrep{END}")), [255.0; 4], "the counter's range");
    let leave = format!("rep i0\nbreak_ge r0.x, r1.x\nadd r0, r0, c1\nendrep{END}");
    assert_eq!(lanes(&leave), [0.0, 1.0, 2.0, 3.0]);
    let within = format!("rep i0\nadd r0, r0, c1\nif_gt r0.x, r1.x\nbreak\nendif\nendrep\nadd r0, r0, c3{END}");
    assert_eq!(lanes(&within), [4.0, 5.0, 6.0, 6.0], "lanes that left run on after the loop");
    let nested = format!("rep i0\nrep i0\nbreak_ge r0.x, r1.x\nadd r0, r0, c1\nendrep\nadd r0, r0, c1\nendrep{END}");
    // The outer loop adds 1 per pass, independently of the inner one: 0: 1 2 3; 1: 1+1, +1, +1; 2: 2+1 ...; 3: 3+1 ...
    assert_eq!(lanes(&nested), [3.0, 4.0, 5.0, 6.0]);
}

#[test]
fn predicates_mask_by_lane_and_component() {
    let body = format!("setp_gt p0.x, r1.x, c1.x\n(p0.x) mov r0, c3\n(!p0.x) add r0, r0, c1{END}");
    assert_eq!(lanes(&body), [1.0, 1.0, 3.0, 3.0]);
    let swizzled = format!("setp_lt p0, r1, c1\n(p0.y) mov r0.x, c2\n(p0.x) add r0.x, r0, c1{END}");
    assert_eq!(lanes(&swizzled), [3.0, 2.0, 2.0, 2.0], "t0.y is 0 in every lane");
    assert_eq!(lanes(&format!("setp_eq p0, r1, c2\nif p0.x\nmov r0, c1\nendif{END}")), [0.0, 0.0, 1.0, 0.0]);
    assert_eq!(
        lanes(&format!("rep i0\nadd r0, r0, c1\nsetp_ge p0, r0, r1\nbreakp p0.x\nendrep{END}")),
        [1.0, 1.0, 2.0, 3.0]
    );
}

#[test]
fn subroutines_return_by_lane() {
    let call = "call l0\nadd r0, r0, c2\nmov oC0, r0\nret\nlabel l0\nadd r0, r0, c1\nret";
    assert_eq!(lanes(call), [3.0; 4]);
    let conditional = "callnz l0, b1\ncallnz l0, b0\nmov oC0, r0\nret\nlabel l0\nadd r0, r0, c1\nret";
    assert_eq!(lanes(conditional), [1.0; 4]);
    let predicated = "setp_gt p0, r1, c1\ncallnz l0, p0.x\nmov oC0, r0\nret\nlabel l0\nadd r0, r0, c1\nret";
    assert_eq!(lanes(predicated), [0.0, 0.0, 1.0, 1.0]);
    let nested = "call l0\nmov oC0, r0\nret\nlabel l0\nadd r0, r0, c1\ncall l1\nadd r0, r0, c1\nret\nlabel l1\nadd r0, r0, c3\nret";
    assert_eq!(lanes(nested), [5.0; 4]);
}

#[test]
fn vertex_loops_count_in_al() {
    let mut host = constants(&[[1.0; 4], [10.0; 4], [100.0; 4], [1000.0; 4], [0.0; 4]]);
    host.int = vec![[2, 1, 2, 0]];
    let text =
        "vs_2_0\ndcl_position v0\nmov r0, c4\nloop aL, i0\nadd r0, r0, c[aL]\nendloop\nmov oT0, r0\nmov oPos, v0";
    let result = run_vertex(text, &ideal("e8m23"), &host, &[[0.0, 0.0, 0.0, 1.0]]);
    assert_eq!(result.vertex.texcoords[0], bits([1010.0; 4]), "c1 and c3");
    let flow =
        "vs_2_0\ndcl_position v0\nmov oPos, v0\nmov r0, c0\nif b0\nmov r0, c1\nelse\nmov r0, c2\nendif\nmov oT0, r0";
    for (flag, expected) in [(true, 10.0), (false, 100.0)] {
        let host = Constants { boolean: vec![flag], ..host.clone() };
        let result = run_vertex(flow, &ideal("e8m23"), &host, &[[0.0, 0.0, 0.0, 1.0]]);
        assert_eq!(result.vertex.texcoords[0], bits([expected; 4]));
    }
}
