//! `crossbar all-frequency factor`: reflectance as a sum of products.

use std::path::PathBuf;

use clap::ArgGroup;

use super::factor_values::{LimitArg, ModelArg, SupersamplesArg};
use crate::all_frequency::factor::{
    Denominators, FactorSampling, FresnelForm, Lobe, MAX_MAP_SIDE, Shadowing, load_product_table,
};
use crate::cli::memory::MemoryNeed;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::{Problem, given};
use crate::error::InputError;
use crate::options::number;
use crate::options::one_of::variants;
use crate::study::prt::{BrdfFactors, FactorSubject};
use crate::transfer::brdf::Brdf;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency factor --brdf cook-torrance --roughness 0.4 --fresnel 0.5
      ten terms of the paper's first reflectance: errors, pictures, tables of G and F
  crossbar all-frequency factor --brdf schlick --roughness 0.2 --isotropy 0.2 --fresnel 0.8 --denominators quarter
      the second, without pi and cosines in the denominator
  crossbar all-frequency factor --brdf cook-torrance --fresnel-form constant --shadowing none --denominators product --sweep-roughness 0.2,0.3,0.5
      other forms of its factors, and three roughnesses side by side
  crossbar all-frequency factor --table docs/examples/reflectance.csv --terms 4 --json
      any table of reflectance times cosine: a row per view, a column per light, by texels of square parabolic maps

Written to --out: index.html (self-contained), pictures, singular_values.csv, view_factors and light_factors as .csv and .npy, tables. \
docs/papers/all_frequency.md says what the options are.";

/// Options of a model, which a table has no use for.
const OF_MODEL: [&str; 8] =
    ["roughness", "fresnel", "isotropy", "exponent", "albedo", "denominators", "fresnel_form", "shadowing"];
/// Options of how reflectance is sampled, which a table is already.
const OF_SAMPLING: [&str; 3] = ["side", "supersamples", "clamp"];

/// Factor reflectance into functions of view and of light: singular values, errors, tables
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true,
          group = ArgGroup::new("subject").args(["brdf", "table"]).required(true))]
pub(super) struct Args {
    /// A model of reflectance
    #[arg(long, value_enum, value_name = "MODEL")]
    brdf: Option<ModelArg>,

    /// A table of reflectance times the light's cosine, CSV or NumPy's: a row per texel of the view's map, a column per
    /// texel of the light's, both square
    #[arg(long, value_name = "FILE", conflicts_with_all = OF_MODEL.iter().chain(&OF_SAMPLING))]
    table: Option<PathBuf>,

    /// Roughness of cook-torrance and schlick [default: the paper's, 0.4 and 0.2]
    #[arg(long, value_name = "R", value_parser = number::positive)]
    roughness: Option<f64>,

    /// Reflectance of the facets at normal incidence; the lobe's for phong [default: the paper's, 0.5 and 0.8; 0.5]
    #[arg(long, value_name = "F", value_parser = number::not_negative)]
    fresnel: Option<f64>,

    /// Isotropy of schlick, up to 1 [default: 0.2]
    #[arg(long, value_name = "P", value_parser = number::positive)]
    isotropy: Option<f64>,

    /// Exponent of phong [default: 20]
    #[arg(long, value_name = "N", value_parser = number::not_negative)]
    exponent: Option<f64>,

    /// Reflectance of the diffuse part [default: 1 for lambert, 0 for others]
    #[arg(long, value_name = "A", value_parser = number::not_negative)]
    albedo: Option<f64>,

    /// Denominator of the lobe of cook-torrance and schlick [default: normalised]
    #[arg(long, value_name = "D", value_parser = variants::<Denominators>())]
    denominators: Option<Denominators>,

    /// Fresnel's term of cook-torrance and schlick [default: dielectric and schlick]
    #[arg(long, value_name = "FORM", value_parser = variants::<FresnelForm>())]
    fresnel_form: Option<FresnelForm>,

    /// Shadowing of cook-torrance and schlick [default: model]
    #[arg(long, value_name = "S", value_parser = variants::<Shadowing>())]
    shadowing: Option<Shadowing>,

    /// Texels along an edge of the parabolic maps
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..=MAX_MAP_SIDE as i64))]
    side: u32,

    /// Samples along an edge of a view's and of a light's texel; the paper's 16 x 16 may be 4x4, 16x1, 1x16 or 16x16
    #[arg(long, value_name = "VxL", default_value = "4x4", allow_hyphen_values = true)]
    supersamples: SupersamplesArg,

    /// Cut off reflectance times cosine at this value, or at `none`
    #[arg(long, value_name = "LIMIT", default_value = "3", allow_hyphen_values = true)]
    clamp: LimitArg,

    /// Terms [default: 10, or the rank of the table where that is less]
    #[arg(long, value_name = "M", value_parser = clap::value_parser!(u32).range(1..))]
    terms: Option<u32>,

    /// The same model with each of these roughnesses too, as in Figure 3
    #[arg(long, value_name = "R,...", value_delimiter = ',', value_parser = number::positive, allow_hyphen_values = true)]
    sweep_roughness: Vec<f64>,

    /// Where to write the page, the pictures and the tables
    #[arg(long, value_name = "DIR", default_value = "out/all-frequency-factor")]
    out: PathBuf,
}

impl Args {
    fn sampling(&self) -> FactorSampling {
        FactorSampling { side: self.side as usize, supersamples: self.supersamples.0, limit: self.clamp.0 }
    }

    fn lobe(&self, lobe: Lobe) -> Result<FactorSubject, Problem> {
        let lobe = Lobe {
            albedo: self.albedo.unwrap_or(0.0),
            fresnel: self.fresnel_form.unwrap_or(lobe.fresnel),
            shadowing: self.shadowing.unwrap_or_default(),
            denominators: self.denominators.unwrap_or_default(),
            ..lobe
        };
        lobe.check().map_err(|error| refused(&error))?;
        Ok(FactorSubject::Lobe(lobe))
    }

    /// Refuses figures of other models than this one.
    fn refuse_others(&self, model: ModelArg) -> Result<(), Problem> {
        use ModelArg::{CookTorrance, Lambert, Phong, Schlick};
        let figures: [(&str, bool, &[ModelArg]); 7] = [
            ("--roughness", self.roughness.is_some(), &[CookTorrance, Schlick]),
            ("--fresnel", self.fresnel.is_some(), &[CookTorrance, Schlick, Phong]),
            ("--isotropy", self.isotropy.is_some(), &[Schlick]),
            ("--exponent", self.exponent.is_some(), &[Phong]),
            ("--denominators", self.denominators.is_some(), &[CookTorrance, Schlick]),
            ("--fresnel-form", self.fresnel_form.is_some(), &[CookTorrance, Schlick]),
            ("--shadowing", self.shadowing.is_some(), &[CookTorrance, Schlick]),
        ];
        let name = match model {
            CookTorrance => "cook-torrance",
            Schlick => "schlick",
            Phong => "phong",
            Lambert => "lambert",
        };
        let foreign = figures.into_iter().map(|(option, given, models)| (option, given && !models.contains(&model)));
        given::refuse(foreign, &format!("other models than {name}"), "leave it out, or choose another `--brdf`")
    }

    fn model(&self, model: ModelArg) -> Result<FactorSubject, Problem> {
        self.refuse_others(model)?;
        let of_brdf = |brdf: Brdf| brdf.check().map(|()| FactorSubject::Brdf(brdf)).map_err(|error| refused(&error));
        match model {
            ModelArg::CookTorrance => {
                self.lobe(Lobe::cook_torrance(self.roughness.unwrap_or(0.4), self.fresnel.unwrap_or(0.5)))
            }
            ModelArg::Schlick => {
                let [roughness, fresnel] = [self.roughness.unwrap_or(0.2), self.fresnel.unwrap_or(0.8)];
                self.lobe(Lobe::schlick(roughness, self.isotropy.unwrap_or(0.2), fresnel))
            }
            ModelArg::Phong => {
                let [albedo, specular] = [self.albedo.unwrap_or(0.0), self.fresnel.unwrap_or(0.5)];
                of_brdf(Brdf::Phong { albedo, specular, exponent: self.exponent.unwrap_or(20.0) })
            }
            ModelArg::Lambert => of_brdf(Brdf::Lambert { albedo: self.albedo.unwrap_or(1.0) }),
        }
    }
}

fn refused(error: &InputError) -> Problem {
    Problem::usage(error.to_string(), "see `crossbar all-frequency factor --help`")
}

impl StudyArgs for Args {
    type Study = BrdfFactors;
    const QUICKER: &'static str = "fewer `--terms`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), None, self.table.iter().map(PathBuf::as_path).collect())
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        /// Of each value of the table: it, its copies, and the rotations of its singular values.
        const PER_VALUE: u64 = 160;
        let texels = u64::from(self.side) * u64::from(self.side);
        let (what, help, values) = match &self.table {
            // A number and its comma take two bytes at least.
            Some(path) => {
                let bytes = std::fs::metadata(path).map_or(0, |file| file.len());
                (format!("factoring `{}`", path.display()), "name a smaller table", bytes / 2)
            }
            None => (format!("maps of {0} x {0} texels", self.side), "ask for a smaller `--side`", texels * texels),
        };
        let most = (MAX_MAP_SIDE as u64).pow(4);
        Ok(Some(MemoryNeed { what, bytes: values.min(most).saturating_mul(PER_VALUE), help }))
    }

    fn study(&self) -> miette::Result<BrdfFactors> {
        let (name, subject) = match (&self.table, self.brdf) {
            (Some(path), _) => (path.display().to_string(), FactorSubject::Table(load_product_table(path)?)),
            (None, model) => {
                let model = model.unwrap_or(ModelArg::CookTorrance);
                let name = match model {
                    ModelArg::CookTorrance => "Cook and Torrance's model",
                    ModelArg::Schlick => "Schlick's model",
                    ModelArg::Phong => "Phong's model",
                    ModelArg::Lambert => "Lambert's law",
                };
                (name.to_owned(), self.model(model)?)
            }
        };
        let sampling = self.sampling();
        Ok(BrdfFactors {
            name,
            subject,
            sampling,
            terms: self.terms.map(|terms| terms as usize),
            roughnesses: self.sweep_roughness.clone(),
        })
    }
}
