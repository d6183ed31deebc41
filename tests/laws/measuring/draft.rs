//! Small random cases, as text, and their simplifications.

use std::fmt::Write as _;

use crossbar::geom::random::CounterRng;

/// Stream of random choices.
pub(super) struct Dice {
    stream: CounterRng,
    at: u64,
}

/// Case of a pixel program with few instructions on few pixels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Draft {
    pub(super) version: &'static str,
    /// Vertex program after its declarations, in which c0 and c1 are constants; empty if there is none.
    pub(super) vertex: Vec<String>,
    /// Instructions, without version and definitions.
    pub(super) lines: Vec<String>,
    pub(super) constants: Vec<[String; 4]>,
    pub(super) texture: Option<Texture>,
    /// Vertices of a triangle as lines of the case; empty for a full-screen quad.
    pub(super) vertices: Vec<String>,
    /// Color of all vertices, and the coordinates of a full-screen quad if they are not 0 to 1.
    pub(super) attributes: Vec<String>,
    pub(super) depth: bool,
    pub(super) size: [u32; 2],
}

/// Texture of bytes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Texture {
    pub(super) format: &'static str,
    pub(super) side: u32,
    pub(super) texels: Vec<[u8; 4]>,
    /// Other lines: filter, levels, bias.
    pub(super) state: Vec<String>,
}

impl Dice {
    pub(super) fn new(name: &str, seed: u64) -> Self {
        let hash = name.bytes().fold(seed, |hash, byte| hash.wrapping_mul(257).wrapping_add(u64::from(byte)));
        Self { stream: CounterRng::new(hash), at: 0 }
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        self.at += 1;
        (self.stream.bits(self.at, 0, 0) % count as u64) as usize
    }

    pub(super) fn pick<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.below(all.len())]
    }

    /// Multiple of 1/256 from -1 to 1.
    fn small(&mut self) -> String {
        (self.below(513) as f64 / 256.0 - 1.0).to_string()
    }
}

impl Texture {
    /// Simpler textures: without a line of state, with fewer texels, with a texel of zeros.
    fn simpler(&self) -> Vec<Self> {
        let mut all = Vec::new();
        for at in 0..self.state.len() {
            let mut texture = self.clone();
            texture.state.remove(at);
            all.push(texture);
        }
        if self.side > 1 {
            let side = self.side / 2;
            let texels = self.texels[..(side * side) as usize].to_vec();
            all.push(Self { side, texels, ..self.clone() });
        }
        for at in 0..self.texels.len() {
            let mut texture = self.clone();
            texture.texels[at] = [0; 4];
            all.push(texture);
        }
        all
    }
}

impl Draft {
    fn new(version: &'static str, dice: &mut Dice) -> Self {
        let constants = (0..4).map(|_| std::array::from_fn(|_| dice.small())).collect();
        Self {
            version,
            vertex: Vec::new(),
            lines: Vec::new(),
            constants,
            texture: None,
            vertices: Vec::new(),
            attributes: vec![format!("v0 = [{}, 0.25, 0.75, 0.5]", dice.below(257) as f64 / 256.0)],
            depth: false,
            size: [2, 2],
        }
    }

    /// Arithmetic of the version on constants and a color.
    pub(super) fn arithmetic(version: &'static str, dice: &mut Dice) -> Self {
        let mut draft = Self::new(version, dice);
        let is_2 = version.starts_with("ps_2");
        if is_2 {
            let special = |dice: &mut Dice| {
                dice.pick(&["0", "1", "0.5", "3", "1e-19", "1e-12", "1e12", "1e19", "1e38", "0.3333", "-0.7"])
                    .to_owned()
            };
            draft.constants = (0..4).map(|_| std::array::from_fn(|_| special(dice))).collect();
        }
        let operations: &[(&str, usize)] = match version {
            "ps_1_1" => &[("add", 2), ("mul", 2), ("mad", 3), ("lrp", 3), ("dp3", 2), ("sub", 2)],
            "ps_1_4" => &[("add", 2), ("mul", 2), ("mad", 3), ("lrp", 3), ("dp3", 2), ("dp4", 2)],
            _ => &[
                ("add", 2),
                ("mul", 2),
                ("mul", 2),
                ("mad", 3),
                ("lrp", 3),
                ("dp3", 2),
                ("dp4", 2),
                ("rcp", 1),
                ("rsq", 1),
            ],
        };
        for at in 0..1 + dice.below(4) {
            let (name, count) = operations[dice.below(operations.len())];
            let modifier = if is_2 { dice.pick(&["", "", "_sat"]) } else { dice.pick(&["", "", "_x2", "_d2", "_x4"]) };
            let source = |dice: &mut Dice| {
                let register = if at == 0 {
                    dice.pick(&["c0", "c1", "c2", "v0"])
                } else {
                    dice.pick(&["r0", "r0", "c1", "c2", "v0"])
                };
                let negated = if name == "lrp" { "" } else { dice.pick(&["", "", "-"]) };
                let scalar = if count == 1 { ".x" } else { "" };
                format!("{negated}{register}{scalar}")
            };
            let sources: Vec<String> = (0..count).map(|_| source(dice)).collect();
            draft.lines.push(format!("{name}{modifier} r0, {}", sources.join(", ")));
        }
        draft.version_ends();
        draft
    }

    /// Adds what ps_2_0 needs besides: a declared color, the output.
    fn version_ends(&mut self) {
        if self.version.starts_with("ps_2") {
            self.lines.insert(0, "dcl v0".to_owned());
            self.lines.push("mov oC0, r0".to_owned());
        }
    }

    /// Texture read over the whole target.
    pub(super) fn textured(version: &'static str, dice: &mut Dice) -> Self {
        let mut draft = Self::new(version, dice);
        draft.lines = match version {
            "ps_1_1" => vec!["tex t0".to_owned(), "mov r0, t0".to_owned()],
            "ps_1_4" => vec!["texld r0, t0".to_owned()],
            _ => ["dcl t0", "dcl_2d s0", "texld r0, t0, s0", "mov oC0, r0"].map(str::to_owned).to_vec(),
        };
        let side = [2, 4, 8][dice.below(3)];
        let mut state = vec![format!("filter = \"{}\"", dice.pick(&["linear", "nearest"]))];
        if dice.below(2) == 0 {
            state.push("mipmaps = \"automatic\"".to_owned());
            state.push(format!("mip = \"{}\"", dice.pick(&["linear", "nearest"])));
            state.push(format!("lod_bias = {}", dice.below(1024) as f64 / 256.0 - 1.0));
        }
        let texels = (0..side * side).map(|_| std::array::from_fn(|_| dice.below(256) as u8)).collect();
        if dice.below(2) == 0 {
            state.push(format!("address = \"border\"\nborder = [{}, 0.3, 0.7, 0.4]", dice.below(256) as f64 / 255.0));
            draft.vertices =
                [[-1, -1], [3, -1], [-1, 3]].map(|[x, y]| format!("position = [{x}, {y}], t0 = [{x}, {y}]")).to_vec();
        }
        let format = dice.pick(&["bgra8", "bgr565", "rgba8", "rgba8s"]);
        draft.texture = Some(Texture { format, side, texels, state });
        draft.size = [1 + dice.below(8) as u32, 1 + dice.below(8) as u32];
        draft
    }

    /// Triangle with an interpolated color and depth.
    pub(super) fn triangle(version: &'static str, dice: &mut Dice) -> Self {
        let mut draft = Self::new(version, dice);
        let is_2 = version.starts_with("ps_2");
        draft.lines =
            if is_2 { vec!["dcl v0".to_owned(), "mov oC0, v0".to_owned()] } else { vec!["mov r0, v0".to_owned()] };
        draft.attributes.clear();
        draft.depth = dice.below(2) == 0;
        draft.size = [4, 4];
        let at = |dice: &mut Dice| (dice.below(4097) as f64 / 2048.0 - 1.0).to_string();
        let high = if dice.below(3) == 0 { 1024 } else { 256 };
        let color =
            |dice: &mut Dice| (dice.below(high + 1) as f64 / 256.0 - if high > 256 { 1.0 } else { 0.0 }).to_string();
        for _ in 0..3 {
            let (x, y, z) = (at(dice), at(dice), dice.below(1025) as f64 / 1024.0);
            let (r, g, b, a) = (color(dice), color(dice), color(dice), color(dice));
            draft.vertices.push(format!("position = [{x}, {y}, {z}], v0 = [{r}, {g}, {b}, {a}]"));
        }
        draft
    }

    /// A vertex program that makes the color.
    pub(super) fn transformed(version: &'static str, dice: &mut Dice) -> Self {
        let mut draft = Self::triangle(version, dice);
        draft.depth = false;
        let special = ["0", "1", "inf", "nan", "1e-40", "1e38", "0.5", "-0.3"];
        draft.constants = (0..4).map(|_| std::array::from_fn(|_| dice.pick(&special).to_owned())).collect();
        // An instruction of vs_1_1 reads one constant.
        let operation = dice.pick(&["mul oD0, r0, c1", "mov oD0, c0", "mad oD0, r0, c1, v1", "add oD0, c0, v1"]);
        draft.vertex = ["mov oPos, v0", "mov r0, c0", operation].map(str::to_owned).to_vec();
        draft
    }

    /// Coordinates in arithmetic, `texkill` and `texdepth`.
    pub(super) fn coordinates(version: &'static str, dice: &mut Dice) -> Self {
        let mut draft = Self::new(version, dice);
        let is_2 = version.starts_with("ps_2");
        let coordinate = |dice: &mut Dice| (dice.below(2049) as f64 / 64.0 - 16.0).to_string();
        draft.attributes = vec![format!(
            "t0 = [{}, {}, {}, {}]",
            coordinate(dice),
            coordinate(dice),
            coordinate(dice),
            coordinate(dice)
        )];
        draft.vertices = [[-1, -1], [3, -1], [-1, 3]].map(|[x, y]| format!("position = [{x}, {y}]")).to_vec();
        let lines: &[&str] = match (is_2, dice.below(3)) {
            (true, _) => &["dcl t0", "texkill t0", "mov r0, c0", "mov oC0, r0"],
            (false, 0) => &["texcrd r0.rgb, t0", "mul_d8 r0.rgb, r0, c0", "+mov r0.a, c0"],
            (false, 1) => &["texcrd r0.rgb, t0", "mov r0.a, c0", "mul_d4 r0, r0, c0"],
            (false, _) => &["texcrd r1.rgb, t0", "mul_d2 r5.rg, r1, c0", "phase", "texdepth r5", "mov r0, c1"],
        };
        draft.lines = lines.iter().map(|line| (*line).to_owned()).collect();
        draft.depth = !is_2;
        draft
    }

    /// The case file on a device.
    pub(super) fn text(&self, device: &str) -> String {
        let mut text = format!("device = \"{device}\"\n\n[pixel]\nsource = \"\"\"\n{}\n", self.version);
        for (at, constant) in self.constants.iter().enumerate().filter(|_| self.vertex.is_empty()) {
            if self.lines.iter().any(|line| line.contains(&format!("c{at}"))) {
                let _ = writeln!(text, "def c{at}, {}", constant.join(", "));
            }
        }
        let _ = writeln!(text, "{}\n\"\"\"", self.lines.join("\n"));
        if !self.vertex.is_empty() {
            let program = self.vertex.join("\n");
            let _ = writeln!(
                text,
                "\n[vertex]\nsource = \"\"\"\nvs_1_1\ndcl_position v0\ndcl_color0 v1\n{program}\n\"\"\""
            );
            let [c0, c1] = [0, 1].map(|at| self.constants[at].join(", "));
            let _ = writeln!(text, "\n[vertex_constants]\nc0 = [{c0}]\nc1 = [{c1}]");
        }
        if let Some(texture) = &self.texture {
            // As many codes as the format has channels.
            let count = if texture.format == "bgr565" { 3 } else { 4 };
            let mask = if count == 3 { 31 } else { 255 };
            let code = |texel: &[u8; 4]| format!("{:?}", &texel.map(|code| code & mask)[..count]);
            let texels: Vec<String> = texture.texels.iter().map(code).collect();
            let _ = writeln!(
                text,
                "\n[[texture]]\nslot = 0\nformat = \"{}\"\nsize = [{side}, {side}]\nraw = true\ntexels = [{}]\n{}",
                texture.format,
                texels.join(", "),
                texture.state.join("\n"),
                side = texture.side,
            );
        }
        text += "\n[geometry]\n";
        if self.vertices.is_empty() {
            text += "full_screen = true\n";
        } else {
            let lines: Vec<String> = self.vertices.iter().map(|line| format!("    {{ {line} }},\n")).collect();
            let _ = writeln!(text, "primitive = \"triangles\"\nvertices = [\n{}]", lines.concat());
        }
        if !self.attributes.is_empty() {
            let _ = writeln!(text, "attributes = {{ {} }}", self.attributes.join(", "));
        }
        let _ = writeln!(text, "\n[target]\nsize = {:?}\nformat = \"bgra8\"\nclear = [0, 0, 0, 0]", self.size);
        if self.depth {
            text += "\n[depth]\nformat = \"d16\"\ntest = \"less-equal\"\nwrite = true\n";
        }
        text
    }

    /// Simpler drafts, the simplest first.
    pub(super) fn simpler(&self) -> Vec<Self> {
        let mut all = Vec::new();
        let mut with = |change: &dyn Fn(&mut Self)| {
            let mut draft = self.clone();
            change(&mut draft);
            if draft != *self {
                all.push(draft);
            }
        };
        with(&|draft| draft.size = [1, 1]);
        with(&|draft| draft.size[0] = (draft.size[0] / 2).max(1));
        with(&|draft| draft.size[1] = (draft.size[1] / 2).max(1));
        with(&|draft| draft.depth = false);
        with(&|draft| draft.attributes.clear());
        for at in 0..self.lines.len() {
            with(&|draft| drop(draft.lines.remove(at)));
            let plain = |draft: &mut Self| {
                for extra in ["_sat", "_x2", "_x4", "_d2", "-"] {
                    draft.lines[at] = draft.lines[at].replace(extra, "");
                }
            };
            with(&plain);
        }
        for simpler in self.texture.iter().flat_map(Texture::simpler) {
            with(&|draft| draft.texture = Some(simpler.clone()));
        }
        for (at, constant) in self.constants.iter().enumerate() {
            for (component, value) in constant.iter().enumerate() {
                for plain in ["0", "1", "0.5"] {
                    let is_plain =
                        ["0", "1", "0.5"].iter().take_while(|other| **other != plain).any(|other| other == value);
                    if !is_plain {
                        with(&|draft| plain.clone_into(&mut draft.constants[at][component]));
                    }
                }
            }
        }
        all
    }
}
