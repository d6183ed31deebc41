//! Assembly: text to programs and back.
use refsim::asm::{assemble, print};

#[test]
fn smoke() {
    let text = "ps.1.4\r\n// c\ndef c0, 1.0, 2, -0.5e-3, 0\ntexcrd r0.rgb, t0_dw.xyw\ntexld r1 t1.xyz_dz\nphase\n+ add_x2_sat r0.rgb, 1-r0, -r1_bx2.a + mov r0.a, c[3]\n";
    let p = assemble(text).unwrap();
    println!("{}", print(&p));
    assert_eq!(assemble(&print(&p)).unwrap(), p);
    let bad = "ps_2_a\nad r0, r1, r2\nadd r0.gr, r1,, r2\ndef c0, 1, 2\ndcl_foo t0\nmov r0, c99999999999\nsetp r0, r1, r2\nif_gt r0.x, r1 mov c[a0.x + 3], r0\n(p1) mov r0, r1\nmov r0, c[\nmov r1, r0,\nmov r1.zz, t0.q, -1\nmov";
    for e in assemble(bad).unwrap_err().errors {
        println!(
            "{:?} {e} | {}",
            &bad[e.span.start as usize..e.span.end as usize],
            e.help
        );
    }
}
