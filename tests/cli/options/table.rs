//! Command lines and option values for the test of all options.

/// A command: lines to which its options are added, and its options with values.
pub(super) struct Tried {
    /// Command lines without the program's name; ` < ` precedes standard input, in which `;` ends a line.
    pub(super) bases: &'static [&'static str],
    /// Options as `--name=value` or `--name`, each tried on every base that succeeds; `@0,2` restricts it to these
    /// bases if the others rightly ignore it. The prefix `same:` requires the same result: the option selects an
    /// executor, not what is computed.
    pub(super) options: &'static str,
}

/// The camera's options.
macro_rules! eye {
    () => {
        " --size=9x7 --eye=3,-4,2 --target=0.2,0.1,0.3 --tan-half-height=0.2"
    };
}

/// The options of a picture under distant light.
macro_rules! picture {
    ($model:literal) => {
        concat!(eye!(), " --exposure=0.3 --model=white-box --model-up=y --strict@", $model, " --light=red-and-blue")
    };
}

/// The options of a card.
macro_rules! card {
    ($device:literal) => {
        concat!(" --sweep --device=", $device, " --switch=target-rounding=truncate same:--executor=scalar")
    };
}

/// The options of a ray caster, for the first base, and for the last, which uses a Ray Engine with rates.
macro_rules! caster {
    ($engine:literal) => {
        concat!(
            " --caster=engine@0 --caster-device=r200 --caster-format=fp16@0,",
            $engine,
            " --octree=1,1@",
            $engine,
            " --pass-triangles=9,99@",
            $engine,
            " --pass-rays=9999@",
            $engine,
            " --readback=free@",
            $engine
        )
    };
}

/// Every command.
pub(super) const TABLE: &[Tried] = &[
    Tried {
        bases: &[
            "alu mul --format fp16 < 3C01 03FF;3C00 4000",
            "alu mul --format fp16 --flags < 3C01 03FF;3C00 4000",
            "alu mul --format fp16 --verify --flags < 3C01 03FF 0400 03;3C00 4000 4000 00",
            "alu roundToInt --format fp16 --flags < 3E00",
            "alu convert --format fp16 --to fp32 < 3E01",
            "alu sqrt --format s1.3 < 18",
            "alu dot --format fp16 < 6800 3C00 3C00 3C00 3C00 3C00",
            "alu quantize --format fp32 --block mxfp4 < 3f9ccccd",
            "alu mul --format e4m3fn:rst < 3B 3B",
            "alu mul --device nv30 < 3FC00001 3F800001;00000000 7F800000",
            "alu dot --unit hopper-f16 < 3C008C00 3C000C00 00000000",
        ],
        options: "--format=bf16@0,1,2,3,4,5,6 --to=fp24 --verify --flags --accumulator=fp32 --summation=exact --block=mxfp6-e3m2 --seed=1 --device=nv20 --stage=pixel --state=legacy --unit=volta-f16@10",
    },
    Tried {
        bases: &["atlas square.obj --side 8 --size 8x8 --out OUT", "atlas odd.obj --side 8 --size 8x8 --out OUT"],
        options: "--side=16 --size=9x7 --out=other --model-up=y --strict@1",
    },
    Tried {
        bases: &["check docs/examples/intersect.psa --device r200"],
        options: "--device=nv20 --switch=rounding=nowhere",
    },
    Tried {
        bases: &["compare docs/examples/product.toml", "compare docs/examples/product.toml --left-format fp16"],
        options: "--left=batch --right=scalar@0 --left-device=ideal-fp16 --right-device=ideal-fp16 \
                  --left-format=s3.12 --right-format=s3.12 --left-switch=rounding=rtz --right-switch=rounding=rtz \
                  --pixel=1,1 --registers",
    },
    Tried { bases: &["completions bash"], options: "" },
    Tried { bases: &["devices", "devices r200"], options: "--adapters" },
    Tried {
        bases: &["diff docs/examples/exact.png docs/examples/leaky.png --out OUT"],
        options: "--channel=G --exposure=2 --ppd=30 --scale=0.5 --max-rmse=0 --max-error=0 --max-flip=0 --min-ssim=1 \
                  --out=other",
    },
    Tried {
        bases: &[
            "intersect --mesh odd.obj --rays rays.csv --out OUT",
            "intersect --mesh odd.obj --rays rays.csv --device r200 --out OUT",
            "intersect --mesh odd.obj --rays rays.csv --caster engine --out OUT",
            "intersect --mesh odd.obj --rays rays.csv --caster host --out OUT",
            "intersect --mesh docs/examples/teapot.obj --rays many.csv --caster engine --caster-device r300 --pass-rays 2 --out OUT",
        ],
        options: concat!(
            "--mesh=square.obj --rays=rays_2.csv --sides=both@0,1,2,3 same:--sides=both@4 --device=r200@0,2,3 --device=ideal-fp16@1 --executor=exact@1,2,3 same:--executor=scalar@1 \
                  --caster=engine@1,3 --caster=host@2 --time --out=other.csv --model-up=y --strict@0,1,2,3 same:--strict@4",
            caster!("4")
        ),
    },
    Tried {
        bases: &[
            "leaky-teapot --size 8x8 --tessellation 1 --rays-per-edge 1 --format fp16 --out OUT",
            "leaky-teapot --mesh odd.obj --size 8x8 --rays-per-edge 0 --format fp16 --out OUT",
            "leaky-teapot --mesh odd.obj --rays rays.csv --rays-per-edge 0 --format fp16 --out OUT",
        ],
        options: concat!(
            "--mesh=square.obj --rays=rays_2.csv --tessellation=2 --device=nv20 --format=fp24 --kernel=shared-edges --out=other \
             --rays-per-edge=2@0,1 --sides=both@0,2 same:--sides=both@1 same:--executor=scalar --model-up=y --strict",
            eye!()
        ),
    },
    Tried { bases: &["man --out OUT"], options: "--out=other" },
    Tried { bases: &["materials", "materials marble"], options: "" },
    Tried {
        bases: &[
            "radiosity docs/examples/room.toml --patches 30 --size 8x8 --iterations 3 --out OUT",
            "radiosity odd.obj --patches 8 --size 8x8 --iterations 3 --out OUT",
            "radiosity docs/examples/room.toml --patches 30 --size 8x8 --factors unoccluded --solver jacobi --out OUT",
            "radiosity docs/examples/room.toml --patches 60 --size 8x8 --solver direct --caster engine --caster-device r300 --pass-rays 2 \
             --out OUT",
        ],
        options: concat!(
            "--patches=12 --factors=unoccluded@0 same:--factors=unoccluded@1 --enforce-closure --solver=gauss-seidel \
                  --packing=luminance --storage=fp16 --device=nv30 --switch=rounding=rtz same:--executor=scalar \
                  --tolerance=0.5 --iterations=2 --picture-after=1,2 \
                  --sweep-patches=12,30 same:--view=front@0,2 --view=front@1 --out=other --model-up=y \
                  --strict@1 --size=9x7",
            caster!("3")
        ),
    },
    Tried {
        bases: &[
            "render docs/examples/room.obj --size 8x8 --renderer eye --eye 0.2,-1,0.2 --out OUT",
            "render cornell-box --size 8x8 --renderer whitted --samples 1 --out OUT",
            "render cornell-box --size 8x8 --renderer distributed --samples 2 --out OUT",
            "render cornell-box --size 8x8 --renderer path --samples 2 --out OUT",
            "render cornell-box --size 8x8 --renderer photon --samples 1 --photons 200 --gather 2 --out OUT",
            "render docs/examples/teapot.obj --size 8x8 --out OUT",
            "render odd.obj --size 8x8 --out OUT",
            "render cornell-box --size 8x8 --caster engine --caster-device r300 --out OUT",
            "render harbour --size 8x8 --renderer environment --out OUT",
        ],
        options: concat!(
            "--device=ideal-fp16 --executor=batch@0,1,2,3,4,5,6 same:--executor=scalar@7,8 --out=other \
             --renderer=eye@1,2,3,4,5,6 --samples=3 --drawn-eyes \
             --depth=1@0,3,4,5,6 same:--depth=1@2 --seed=2@2,3,4,5,6 same:--seed=2@0,1 \
             --view=front@0,5,6 same:--view=front@1,2,3,4 --exposure=0.3 \
             --lens=0.1,1 --photons=100 --gather=1 --caster=engine@1,2,3,4,5,6 --model-up=y --strict@6",
            caster!("7"),
            eye!()
        ),
    },
    Tried {
        bases: &["reproduce ray-engine-equation-11 --out OUT"],
        options: "--list same:--full-size --out=other --record=other",
    },
    Tried {
        bases: &[
            "run docs/examples/product.toml --out OUT",
            "run docs/examples/wgsl/fresnel.wgsl --uniform f0=0.04,0.3,0.9 --out OUT",
        ],
        options: "--out=other same:--executor=batch --trace=0,0 --uniform=f0=0.5,0.5,0.5",
    },
    Tried { bases: &["scene white-box", "scene white-box --out OUT"], options: "--out=other" },
    Tried {
        bases: &[
            "subsurface square.obj --mm-per-unit 10 --material marble --atlas 8 --links 4 --size 8x8 --out OUT",
            "subsurface odd.obj --mm-per-unit 10 --sigma-s 1 --sigma-a 0.1 --atlas 8 --links 4 --size 8x8 --out OUT",
            "subsurface square.obj --mm-per-unit 10 --material marble --atlas 8 --links 4 --light disk:1,0,2:20 --size 8x8 \
             --out OUT",
            "subsurface docs/examples/step.obj --mm-per-unit 10 --material marble --atlas 16 --links 4 --light disk:1,0,2:20 \
             --size 8x8 --caster engine --caster-device r300 --out OUT",
        ],
        options: concat!(
            "--caster=engine@2 --material=skin1 --sigma-s=2 --sigma-a=0.2 --eta=1.4 --mm-per-unit=20 --atlas=32 --links=16 \
             --choice=adaptive --channels=scalar --link-format=fp32 --map=8bit --tolerance=0.5 \
             --light=ambient:1,1,1 --all-pairs=no --device=nv30 --switch=rounding=rtz \
             same:--executor=scalar --out=other --model-up=y --strict@1",
            caster!("3"),
            eye!()
        ),
    },
    Tried {
        bases: &["timeline docs/examples/product.toml", "timeline --eye-rays 4x4"],
        options: "--eye-rays=5x4 --device=nv20 --readback=async --double-buffer --cache@1 \
                  --sensitivity --perfetto=trace.json",
    },
    Tried { bases: &["tour --size 8x8 --coarser 8 --out OUT"], options: "--size=9x7 --coarser=7 --out=other" },
    Tried {
        bases: &[
            "cpca precompute docs/examples/room.obj --order 2 --degree 18 --out OUT.npz",
            "cpca precompute square.obj --kind glossy --order 2 --rows 4 --degree 18 --brdf phong:0.2,0.3,4 --out OUT.npz",
            "cpca precompute odd.obj --kind glossy --order 2 --rows 4 --degree 18 --bounces 1 --out OUT.npz",
            "cpca precompute square.obj --order 2 --degree 18 --material marble --mm-per-unit 10 --out OUT.npz",
            "cpca precompute docs/examples/room.obj --order 2 --degree 18 --caster engine --caster-device r300 --out OUT.npz",
        ],
        options: concat!(
            "--kind=glossy@0 --order=3 --rows=9 --brdf=lambert:0.3 --material=skin1@3 --mm-per-unit=2@3 --channels=rgb \
                  --tangents=1,2,3@1,2 --degree=20 --bounces=2 --out=other.npz \
                  --model-up=y --strict@2",
            caster!("4")
        ),
    },
    Tried {
        bases: &[
            "cpca compress docs/examples/step.npz --clusters 4 --vectors 2 --out OUT.npz",
            "cpca compress docs/examples/step.npz --clusters 9 --vectors 2 --model docs/examples/step.obj \
             --reclassify 0.5 --out OUT.npz",
            "cpca compress docs/examples/step.npz --clusters 4 --vectors 2 --model odd.obj --reclassify 0.5 --out OUT.npz",
        ],
        options: "--clusters=5@0,1 --vectors=1@0,1 --method=adaptive@0,1 --model=white-box@0,1 --reclassify=0@0,1 \
                  --out=other.npz@0,1 --model-up=y --strict@2",
    },
    Tried { bases: &["cpca error docs/examples/step.npz docs/examples/step_small.npz"], options: "" },
    Tried { bases: &["cpca show docs/examples/step_small.npz"], options: "" },
    Tried {
        bases: &[
            "cpca render docs/examples/step.npz --model docs/examples/step.obj --size 8x6 --out OUT",
            "cpca render docs/examples/step.npz --model odd.obj --size 8x6 --out OUT",
            "cpca render docs/examples/step_small.npz --model docs/examples/step.obj --size 8x6 --out OUT",
        ],
        options: concat!("--original=docs/examples/step.npz@0,2 --out=other@0,2", picture!("1")),
    },
    Tried {
        bases: &[
            "cpca card docs/examples/step_small.npz --model docs/examples/step.obj --size 8x6 --out OUT",
            "cpca card docs/examples/step_small.npz --model odd.obj --size 8x6 --out OUT",
        ],
        options: concat!("--out=other@0", card!("r350"), picture!("1")),
    },
    Tried {
        bases: &[
            "all-frequency factor --brdf cook-torrance --side 4 --terms 2 --out OUT",
            "all-frequency factor --brdf schlick --side 4 --terms 2 --out OUT",
            "all-frequency factor --brdf phong --side 4 --terms 2 --out OUT",
            "all-frequency factor --brdf lambert --side 4 --terms 1 --out OUT",
            "all-frequency factor --table docs/examples/reflectance.csv --terms 2 --out OUT",
        ],
        options: "--brdf=phong@0,1,3,4 --table=docs/examples/reflectance.csv@0,1,2,3 --roughness=0.3 --fresnel=0.3 \
                  --denominators=product --fresnel-form=constant --shadowing=none --side=5 --terms=1@0,1,2,4 --out=other",
    },
    Tried {
        bases: &[
            "all-frequency lighting --light disk:1,0,2:5",
            "all-frequency lighting --light disk:1,0,2:20 --keep 60 --out OUT.csv",
        ],
        options: "--light=red-and-blue --segments=6 --keep=9 --by=magnitude@1 --out=other.csv",
    },
    Tried {
        bases: &[
            "all-frequency precompute docs/examples/room.obj --out OUT.npz",
            "all-frequency precompute odd.obj --out OUT.npz",
            "all-frequency precompute roof.obj --caster engine --caster-device r300 --octree 1,4 --pass-triangles 1,3 --out OUT.npz",
        ],
        options: concat!(
            "--reflectance=factors --ground=3 --tangents=1,2,3 --out=other.npz --model-up=y --strict@1",
            caster!("2")
        ),
    },
    Tried {
        bases: &[
            "all-frequency compress docs/examples/step_all.npz --model docs/examples/step.obj --points-per-cluster 15 \
             --vectors 2 --out OUT.npz",
            "all-frequency compress docs/examples/step_all.npz --model odd.obj --out OUT.npz",
        ],
        options: "--model=white-box --points-per-cluster=30@0 --vectors=3@0 --bits=8@0 --resume=kept@0 \
                  --out=other.npz@0 --model-up=y --strict@1",
    },
    Tried {
        bases: &[
            "all-frequency error docs/examples/step_all.npz docs/examples/step_all_small.npz --model docs/examples/step.obj",
            "all-frequency error docs/examples/step_all.npz docs/examples/step_all_small.npz --model odd.obj",
        ],
        options: "--model=white-box --model-up=y --strict@1",
    },
    Tried { bases: &["all-frequency show docs/examples/step_all_small.npz"], options: "" },
    Tried {
        bases: &[
            "all-frequency render docs/examples/step_all_small.npz --model docs/examples/step.obj --size 8x6 --out OUT",
            "all-frequency render docs/examples/step_all_small.npz --model odd.obj --size 8x6 --out OUT",
            "all-frequency render docs/examples/step_all_small.npz --model docs/examples/step.obj --size 8x6 \
             --ground on.ground.npz --out OUT",
        ],
        options: concat!(
            "--original=docs/examples/step_all.npz@0,2 --keep=9@0,2 --ground=on.ground.npz@0 --out=other@0,2",
            picture!("1")
        ),
    },
    Tried {
        bases: &[
            "all-frequency card glossy.npz --model square.obj --size 8x6 --out OUT",
            "all-frequency card docs/examples/step_all_small.npz --model odd.obj --size 8x6 --out OUT",
            "all-frequency card glossy.npz --model square.obj --way colors --size 8x6 --out OUT",
        ],
        options: concat!(
            "--original=glossy_sight.npz@0,2 --keep=9@0,2 --ground=on.ground.npz@0,2 --way=colors@0 --out=other@0,2",
            card!("nv35"),
            picture!("1")
        ),
    },
    Tried {
        bases: &[
            "bi-scale precompute docs/examples/court.obj --directions 2 --out OUT.npz",
            "bi-scale precompute odd.obj --directions 2 --out OUT.npz",
            "bi-scale precompute docs/examples/court.obj --directions 2 --caster engine --caster-device r300 --out OUT.npz",
        ],
        options: concat!(
            "--directions=3 --crease=10@0 --tangents=1,2,3@0 --out=other.npz --model-up=y --strict@1",
            caster!("2")
        ),
    },
    Tried { bases: &["bi-scale bicluster docs/examples/quarters.mtx --out OUT.npz"], options: "--out=other.npz" },
    Tried {
        bases: &[
            "bi-scale texture bumps --texels 4 --directions 2 --views 2 --out OUT.npy",
            "bi-scale texture heights.csv --texels 4 --directions 2 --views 2 --sheet OUT.png --out OUT.npy",
            "bi-scale texture plain --texels 4 --directions 2 --views 2 --out OUT.npy",
        ],
        options: "--texels=5 --directions=3 --views=3 --out=other.npy --sheet=other.png",
    },
    Tried {
        bases: &["bi-scale show docs/examples/court_biclusters.npz", "bi-scale show court.npz"],
        options: "--matrix=other.mtx",
    },
    Tried {
        bases: &[
            "bi-scale render docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture bumps \
             --texture-size 4 --texture-views 2 --size 8x6 --out OUT",
            "bi-scale render docs/examples/court_biclusters.npz --model odd.obj --texture bumps --size 8x6 --out OUT",
            "bi-scale render docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture plain.npy \
             --size 8x6 --out OUT",
        ],
        options: concat!(
            "--texture=wall=tiles@0,2 --repeat=3@0 --texture-size=5@0,2 --texture-views=3@0,2 --crease=10 --reference@0,2 \
             --out=other@0,2",
            picture!("1")
        ),
    },
    Tried {
        bases: &[
            "bi-scale card docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture bumps \
             --texture-size 4 --texture-views 2 --size 8x6 --out OUT",
            "bi-scale card docs/examples/court_biclusters.npz --model odd.obj --texture bumps --size 8x6 --out OUT",
        ],
        options: concat!(
            "--texture=wall=tiles@0 --repeat=3@0 --texture-size=5@0 --texture-views=3@0 --crease=10 --out=other@0",
            card!("ideal-fp32"),
            picture!("1")
        ),
    },
    Tried {
        bases: &["matmul docs/examples/matmul_a.npy docs/examples/matmul_b.npy --unit hopper-fp8 --out OUT"],
        options: "--unit=ada-fp8 --c=nowhere.npy --type=e5m2 --promote=64 --against=blackwell-f8f6f4 --blame=1,2 \
                  --goal=worst<=0.001 --out=other",
    },
    Tried { bases: &["units", "units hopper-fp8"], options: "" },
    Tried {
        bases: &["measure docs/examples/measured.csv --device nv25"],
        options: "--device=nv20 --switch=rounding=rtz",
    },
    Tried {
        bases: &[
            "precision docs/examples/lerp.toml --out OUT",
            "precision docs/examples/wgsl/fresnel.wgsl --uniform f0=0.04,0.3,0.9 --budget 60 --out OUT",
            "precision --expr sqrt(x+1)-sqrt(x) --goal largest_relative<=9 --samples 30 --out OUT",
        ],
        options: "--expr=x/3 --fpcore=fixtures/fpbench/suite.fpcore --range=x=2..3 --samples=31 --seed=5 --draw=reals \
                  --uniform=f0=0.5,0.5,0.5 --goal=mean_relative<=0.01 --held-back=docs/examples/lerp.toml --device=r300 --switch=mad=fused --family=fixed --budget=7 \
                  --out=other",
    },
    Tried { bases: &["page --out OUT"], options: "--out=other --emulator=missing.wasm" },
];
