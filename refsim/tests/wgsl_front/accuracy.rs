//! Functions within the accuracy that WGSL demands: the tables of section 15.7.4.1 of its specification ("Accuracy of
//! Concrete Floating Point Expressions", gpuweb 000adac), for random operands in f32 and f16. Bounds are computed in
//! doubles, in which sums and products of the operands are exact.

#![expect(clippy::disallowed_methods, reason = "doubles of the host have 29 bits more than what they judge")]

use super::drawn::{Inputs, drawn_of, texels};

/// A closed interval: lower and upper bound.
type Interval = [f64; 2];

/// f32 or f16.
#[derive(Clone, Copy)]
struct Kind {
    digits: i32,
    least: i32,
}

fn hull(values: impl IntoIterator<Item = f64>) -> Interval {
    values.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

impl Kind {
    /// The smaller of a number's distances to its two neighbors.
    fn ulp(self, x: f64) -> f64 {
        let exponent = if x == 0.0 { self.least } else { (x.abs().log2().floor() as i32).max(self.least) };
        let is_power = x.abs() == 2f64.powi(exponent) && exponent > self.least;
        2f64.powi(exponent - self.digits - i32::from(is_power))
    }

    fn is_half(self) -> bool {
        self.digits == 10
    }

    /// The values rounded down and up; WGSL calls either result correctly rounded.
    fn rounded(self, of: impl IntoIterator<Item = f64>) -> Interval {
        let [low, high] = hull(of);
        let [down, up] = [self.ulp(low), self.ulp(high)];
        [(low / down).floor() * down, (high / up).ceil() * up]
    }

    /// An interval of `ulps` units in the last place around the values.
    fn within(self, ulps: f64, values: impl IntoIterator<Item = f64>) -> Interval {
        hull(values.into_iter().flat_map(|x| [x - ulps * self.ulp(x), x + ulps * self.ulp(x)]))
    }

    fn corners(a: Interval, b: Interval, of: fn(f64, f64) -> f64) -> [f64; 4] {
        [of(a[0], b[0]), of(a[0], b[1]), of(a[1], b[0]), of(a[1], b[1])]
    }

    fn add(self, a: Interval, b: Interval) -> Interval {
        self.rounded(Self::corners(a, b, |a, b| a + b))
    }

    fn sub(self, a: Interval, b: Interval) -> Interval {
        self.rounded(Self::corners(a, b, |a, b| a - b))
    }

    fn mul(self, a: Interval, b: Interval) -> Interval {
        self.rounded(Self::corners(a, b, |a, b| a * b))
    }

    fn div(self, a: Interval, b: Interval) -> Interval {
        if b[0] <= 0.0 && b[1] >= 0.0 {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        self.within(2.5, Self::corners(a, b, |a, b| a / b))
    }

    fn dot(self, a: &[Interval], b: &[Interval]) -> Interval {
        let products: Vec<Interval> = a.iter().zip(b).map(|(a, b)| self.mul(*a, *b)).collect();
        products[1..].iter().fold(products[0], |sum, product| self.add(sum, *product))
    }

    fn inverse_sqrt(self, a: Interval) -> Interval {
        if a[0] <= 0.0 { [0.0, f64::INFINITY] } else { self.within(2.0, a.map(|a| a.sqrt().recip())) }
    }

    fn sqrt(self, a: Interval) -> Interval {
        self.div([1.0; 2], self.inverse_sqrt(a))
    }

    fn exp(self, a: Interval, of: fn(f64) -> f64) -> Interval {
        let base = if self.is_half() { 1.0 } else { 3.0 };
        hull(a.into_iter().flat_map(|a| self.within(base + 2.0 * a.abs(), [of(a)])))
    }

    fn log(self, a: Interval, of: fn(f64) -> f64) -> Interval {
        let around = |a: f64| match a {
            0.5..=2.0 => {
                let error = 2f64.powi(if self.is_half() { -7 } else { -21 });
                [of(a) - error, of(a) + error]
            }
            _ => self.within(3.0, [of(a)]),
        };
        hull(a.map(around).concat())
    }

    fn circle(self, a: Interval, of: fn(f64) -> f64) -> Interval {
        let error = 2f64.powi(if self.is_half() { -7 } else { -11 });
        [of(a[0]) - error, of(a[0]) + error]
    }

    /// A literal of the text, correctly rounded.
    fn number(self, x: f64) -> Interval {
        self.rounded([x])
    }

    fn length(self, a: &[Interval]) -> Interval {
        self.sqrt(self.dot(a, a))
    }

    fn clamp(a: Interval, low: f64, high: f64) -> Interval {
        a.map(|a| a.clamp(low, high))
    }

    fn reflect(self, a: [Interval; 2], n: [Interval; 2]) -> Interval {
        let twice = self.mul([2.0; 2], self.dot(&a, &n));
        self.sub(a[0], self.mul(twice, n[0]))
    }

    fn refract(self, [a, n]: [[Interval; 2]; 2], ratio: Interval) -> Interval {
        let d = self.dot(&n, &a);
        let sine = self.sub([1.0; 2], self.mul(d, d));
        let k = self.sub([1.0; 2], self.mul(self.mul(ratio, ratio), sine));
        let along = self.add(self.mul(ratio, d), self.sqrt(k));
        self.sub(self.mul(ratio, a[0]), self.mul(along, n[0]))
    }

    fn smoothstep(self, low: Interval, high: Interval, x: Interval) -> Interval {
        let t = Self::clamp(self.div(self.sub(x, low), self.sub(high, low)), 0.0, 1.0);
        self.mul(self.mul(t, t), self.sub([3.0; 2], self.mul([2.0; 2], t)))
    }
}

/// An expression of a, b, c and d, and the interval in which its value may lie. `T` is the type, `V2` and `V3` are its
/// vectors.
type Row = (&'static str, fn(Kind, [Interval; 4]) -> Interval);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("a + b", |k, [a, b, ..]| k.add(a, b)),
    ("a - b", |k, [a, b, ..]| k.sub(a, b)),
    ("a * b", |k, [a, b, ..]| k.mul(a, b)),
    ("a / b", |k, [a, b, ..]| k.div(a, b)),
    ("-a", |_, [a, ..]| [-a[0]; 2]),
    ("T(a < b)", |_, [a, b, ..]| [f64::from(a[0] < b[0]); 2]),
    ("T(a >= d)", |_, [a, _, _, d]| [f64::from(a[0] >= d[0]); 2]),
    ("abs(a)", |_, [a, ..]| [a[0].abs(); 2]),
    ("ceil(a)", |_, [a, ..]| a.map(f64::ceil)),
    ("floor(a)", |_, [a, ..]| a.map(f64::floor)),
    ("trunc(a)", |_, [a, ..]| a.map(f64::trunc)),
    ("round(a)", |_, [a, ..]| a.map(f64::round_ties_even)),
    ("sign(a)", |_, [a, ..]| a.map(f64::signum)),
    ("step(a, b)", |_, [a, b, ..]| [f64::from(a[0] <= b[0]); 2]),
    ("min(a, d)", |_, [a, _, _, d]| [a[0].min(d[0]); 2]),
    ("max(a, d)", |_, [a, _, _, d]| [a[0].max(d[0]); 2]),
    ("clamp(a, -b, b)", |_, [a, b, ..]| Kind::clamp(a, -b[0], b[0])),
    ("saturate(a)", |_, [a, ..]| Kind::clamp(a, 0.0, 1.0)),
    ("fract(a)", |k, [a, ..]| k.sub(a, a.map(f64::floor))),
    ("fma(a, b, d)", |k, [a, b, _, d]| hull([k.add(k.mul(a, b), d), k.rounded([a[0] * b[0] + d[0]])].concat())),
    ("mix(a, b, c)", |k, [a, b, c, _]| k.add(k.mul(a, k.sub([1.0; 2], c)), k.mul(b, c))),
    ("inverseSqrt(b)", |k, [_, b, ..]| k.inverse_sqrt(b)),
    ("sqrt(b)", |k, [_, b, ..]| k.sqrt(b)),
    ("exp(a)", |k, [a, ..]| k.exp(a, f64::exp)),
    ("exp2(a)", |k, [a, ..]| k.exp(a, f64::exp2)),
    ("log(b)", |k, [_, b, ..]| k.log(b, f64::ln)),
    ("log2(b)", |k, [_, b, ..]| k.log(b, f64::log2)),
    ("pow(b, a)", |k, [a, b, ..]| k.exp(k.mul(a, k.log(b, f64::log2)), f64::exp2)),
    ("sin(d)", |k, [.., d]| k.circle(d, f64::sin)),
    ("cos(d)", |k, [.., d]| k.circle(d, f64::cos)),
    ("tan(c)", |k, [_, _, c, _]| k.div(k.circle(c, f64::sin), k.circle(c, f64::cos))),
    ("degrees(a)", |k, [a, ..]| k.mul(a, k.number(57.295_779_513_082_32))),
    ("radians(a)", |k, [a, ..]| k.mul(a, k.number(0.017_453_292_519_943_295))),
    ("dot(V2(a, b), V2(c, d))", |k, [a, b, c, d]| k.dot(&[a, b], &[c, d])),
    ("dot(V3(a, b, c), V3(c, d, b))", |k, [a, b, c, d]| k.dot(&[a, b, c], &[c, d, b])),
    ("cross(V3(a, b, c), V3(b, c, d)).x", |k, [_, b, c, d]| k.sub(k.mul(b, d), k.mul(c, c))),
    ("length(V3(a, b, c))", |k, [a, b, c, _]| k.length(&[a, b, c])),
    ("distance(V2(a, b), V2(c, d))", |k, [a, b, c, d]| k.length(&[k.sub(a, c), k.sub(b, d)])),
    ("normalize(V3(a, b, c)).x", |k, [a, b, c, _]| k.div(a, k.length(&[a, b, c]))),
    ("reflect(V2(a, b), V2(c, d)).x", |k, [a, b, c, d]| k.reflect([a, b], [c, d])),
    ("refract(V2(a, b), V2(c, d), c * T(0.125)).x", |k, [a, b, c, d]| {
        k.refract([[a, b], [c, d]], k.mul(c, [0.125; 2]))
    }),
    ("faceForward(V2(a, b), V2(1, 0), V2(d, 0)).x", |_, [a, .., d]| [if d[0] < 0.0 { a[0] } else { -a[0] }; 2]),
    ("smoothstep(-b, b, a)", |k, [a, b, ..]| k.smoothstep([-b[0]; 2], b, a)),
];

/// Checks every row for 256 operands: a from -4 to 4, b from 1/4 to 4, c from 0 to 1, d from -3 to 3.
fn hold(kind: Kind, name: &str, bits: u32) {
    for (at, (expression, allowed)) in (0..).zip(ROWS) {
        let texels = texels(at, bits, |[a, b, c, d]| {
            [a * 8.0 - 4.0, b * 3.75 + 0.25, c, d * 6.0 - 3.0].map(|x| {
                // Rounded to the precision of the type.
                let unit = kind.ulp(f64::from(x)) as f32;
                (x / unit).round_ties_even() * unit
            })
        });
        let own = expression.replace("V2", &format!("vec2<{name}>")).replace("V3", &format!("vec3<{name}>"));
        let own = own.replace('T', name);
        let text = format!(
            "enable f16;\n@group(0) @binding(0) var data: texture_2d<f32>;\n@group(0) @binding(1) var near: sampler;\n\
             @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {{\n\
             let t = textureSample(data, near, uv);\n let a = {name}(t.x); let b = {name}(t.y);\n\
             let c = {name}(t.z); let d = {name}(t.w);\n return vec4f(f32({own}));\n}}"
        );
        let pixels = drawn_of(&text, &Inputs { uniforms: &[], texels: &texels, half: &|_| Vec::new() });
        for (pixel, texel) in pixels.iter().zip(&texels) {
            let [low, high] = allowed(kind, texel.map(|x| [f64::from(x); 2]));
            let found = pixel[0];
            let refuses = low.is_nan() || high.is_nan();
            assert!(
                refuses || (low..=high).contains(&found),
                "{expression} in {name} of {texel:?}: {found} is not in {low}..={high}"
            );
        }
    }
}

pub(crate) fn functions_are_as_accurate_as_wgsl_demands_in_f32() {
    hold(Kind { digits: 23, least: -126 }, "f32", 24);
}

pub(crate) fn functions_are_as_accurate_as_wgsl_demands_in_f16() {
    hold(Kind { digits: 10, least: -14 }, "f16", 24);
}
