use crossbar_ground::card::{KernelText, Levels, Texels};
use refsim::device::Profile;
use refsim::machine::{Executor, ExecutorKind};
use refsim::texture::TexelFormat;

const MEAN: KernelText = KernelText {
    name: "mean.fp",
    text: "!!FP1.0\nADDR R0, f[TEX0], {-0.5, -0.5, 0.5, 0.5};\nADDR R0.zw, f[TEX0].xyxy, {0.5}.x;\n\
           TEX R1, R0, TEX0, RECT;\nTEX R2, R0.zyzw, TEX0, RECT;\nTEX R3, R0.xwzw, TEX0, RECT;\n\
           TEX R4, R0.zwzw, TEX0, RECT;\nADDR R1, R1, R2;\nADDR R3, R3, R4;\nADDR R1, R1, R3;\n\
           MULR o[COLR], R1, {0.25}.x;\nEND\n",
};

#[test]
fn levels_hold_the_means_of_four() {
    let nv35 = Profile::named("nv35").expect("a card");
    let program = MEAN.checked(&nv35).expect("the card runs it");
    let mut machine = Executor::from(ExecutorKind::Batch).machine(nv35).expect("a machine");
    let mut level = Texels::from_fn([16, 4], |x, y| [x as f32, y as f32, (x * y) as f32, 1.0]);
    let base = level.upload(&mut machine, TexelFormat::Rgba32f).expect("a texture");
    let levels = Levels::new(&mut machine, TexelFormat::Rgba32f, [16, 4]).expect("targets");
    levels.fill(&mut machine, base, &program).expect("draws");
    assert_eq!(levels.targets().len(), 4, "8 x 2, 4 x 1, 2 x 1, 1 x 1");
    for &target in levels.targets() {
        let size = [level.width, level.height].map(|side| (side / 2).max(1));
        let at = |x: usize, y: usize, c| level.row(y.min(level.height - 1))[x][c];
        level = Texels::from_fn(size, |x, y| {
            let (x, y) = (2 * x, 2 * y);
            let row = |y, c| [at(x, y, c), at(x + 1, y, c)];
            [0, 1, 2, 3].map(|c| (row(y, c)[0] + row(y, c)[1] + (row(y + 1, c)[0] + row(y + 1, c)[1])) * 0.25)
        });
        assert_eq!(Texels::read_back(&machine, target).expect("a target"), level);
    }
    assert_eq!(level.texels[0][3], 1.0);
}
