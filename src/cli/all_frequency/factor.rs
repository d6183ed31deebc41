//! `crossbar all-frequency factor`: reflectance as a sum of products.

use std::path::PathBuf;

use clap::{ArgGroup, ValueEnum};

use crate::all_frequency::factor::{
    Denominators, FactorSampling, FresnelForm, Lobe, MAX_MAP_SIDE, Shadowing, load_product_table,
};
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
  crossbar all-frequency factor --brdf schlick --roughness 0.2 --fresnel 0.8 --denominators quarter
      the paper's second reflectance, divided by 4 only: no pi and no cosines in the denominator
  crossbar all-frequency factor --brdf cook-torrance --fresnel-form constant --shadowing none --denominators product
      the first reflectance with other forms of its factors
  crossbar all-frequency factor --table docs/examples/reflectance.csv --terms 4 --json
      any table of reflectance times cosine: one row per view and one column per light, \
both of them texels of a square parabolic map

Written to --out: index.html (self-contained), pictures, singular_values.csv, view_factors and light_factors as .csv and .npy, tables. \
docs/papers/all_frequency.md explains the options.";

/// Isotropy of Schlick's model, as in the paper.
const ISOTROPY: f64 = 0.2;
const EXPONENT: f64 = 20.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ModelArg {
    /// Cook and Torrance 1982
    CookTorrance,
    /// Schlick 1994, anisotropic
    Schlick,
    /// Phong, as in MTL files
    Phong,
    /// The same radiance in all directions
    Lambert,
}

/// Options of a reflectance model, which do not apply to a table.
const OF_MODEL: [&str; 5] = ["roughness", "fresnel", "denominators", "fresnel_form", "shadowing"];

/// Factor reflectance into functions of view and of light: singular values, errors, tables
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true,
          group = ArgGroup::new("subject").args(["brdf", "table"]).required(true))]
pub(super) struct Args {
    /// A model of reflectance
    #[arg(long, value_enum, value_name = "MODEL")]
    brdf: Option<ModelArg>,

    /// A table of reflectance times the cosine of the light's angle, as CSV or NumPy array: one row per texel of
    /// the view map and one column per texel of the light map, both square
    #[arg(long, value_name = "FILE", conflicts_with = "side", conflicts_with_all = OF_MODEL)]
    table: Option<PathBuf>,

    /// Roughness of cook-torrance and schlick [default: 0.4 for cook-torrance, 0.2 for schlick, as in the paper]
    #[arg(long, value_name = "R", value_parser = number::positive)]
    roughness: Option<f64>,

    /// Reflectance at normal incidence, or of the lobe for phong [default: 0.5, or 0.8 for schlick, as in the paper]
    #[arg(long, value_name = "F", value_parser = number::not_negative)]
    fresnel: Option<f64>,

    /// Denominator of the lobe of cook-torrance and schlick [default: normalised]
    #[arg(long, value_name = "D", value_parser = variants::<Denominators>())]
    denominators: Option<Denominators>,

    /// Fresnel term of cook-torrance and schlick [default: dielectric for cook-torrance, schlick for schlick]
    #[arg(long, value_name = "FORM", value_parser = variants::<FresnelForm>())]
    fresnel_form: Option<FresnelForm>,

    /// Shadowing of cook-torrance and schlick [default: model]
    #[arg(long, value_name = "S", value_parser = variants::<Shadowing>())]
    shadowing: Option<Shadowing>,

    /// Texels along an edge of the parabolic maps
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = number::whole::<u32>(1..=MAX_MAP_SIDE as u32))]
    side: u32,

    /// Number of terms [default: 10, or the rank of the table if that is less]
    #[arg(long, value_name = "M", value_parser = number::whole::<u32>(1..=u32::MAX))]
    terms: Option<u32>,

    /// Where to write the page, the pictures and the tables
    #[arg(long, value_name = "DIR", default_value = "out/all-frequency-factor")]
    out: PathBuf,
}

impl Args {
    fn lobe(&self, lobe: Lobe) -> Result<FactorSubject, InputError> {
        let lobe = Lobe {
            fresnel: self.fresnel_form.unwrap_or(lobe.fresnel),
            shadowing: self.shadowing.unwrap_or_default(),
            denominators: self.denominators.unwrap_or_default(),
            ..lobe
        };
        lobe.check().map(|()| FactorSubject::Lobe(lobe))
    }

    /// Rejects options that this model does not have.
    fn refuse_others(&self, model: ModelArg) -> Result<(), Problem> {
        let (name, is_lobe) = match model {
            ModelArg::CookTorrance => ("cook-torrance", true),
            ModelArg::Schlick => ("schlick", true),
            ModelArg::Phong => ("phong", false),
            ModelArg::Lambert => ("lambert", false),
        };
        let foreign = [
            ("--roughness", self.roughness.is_some() && !is_lobe),
            ("--fresnel", self.fresnel.is_some() && model == ModelArg::Lambert),
            ("--denominators", self.denominators.is_some() && !is_lobe),
            ("--fresnel-form", self.fresnel_form.is_some() && !is_lobe),
            ("--shadowing", self.shadowing.is_some() && !is_lobe),
        ];
        given::refuse(foreign, &format!("models other than {name}"), "remove the option, or choose another `--brdf`")
    }

    fn model(&self, model: ModelArg) -> Result<(&'static str, FactorSubject), Problem> {
        self.refuse_others(model)?;
        let [roughness, fresnel] = [self.roughness, self.fresnel];
        let of_brdf = |brdf: Brdf| brdf.check().map(|()| FactorSubject::Brdf(brdf));
        let (name, subject) = match model {
            ModelArg::CookTorrance => {
                let lobe = Lobe::cook_torrance(roughness.unwrap_or(0.4), fresnel.unwrap_or(0.5));
                ("Cook and Torrance's model", self.lobe(lobe))
            }
            ModelArg::Schlick => {
                let lobe = Lobe::schlick(roughness.unwrap_or(0.2), ISOTROPY, fresnel.unwrap_or(0.8));
                ("Schlick's model", self.lobe(lobe))
            }
            ModelArg::Phong => {
                let brdf = Brdf::Phong { albedo: 0.0, specular: fresnel.unwrap_or(0.5), exponent: EXPONENT };
                ("Phong's model", of_brdf(brdf))
            }
            ModelArg::Lambert => ("Lambert's law", of_brdf(Brdf::Lambert { albedo: 1.0 })),
        };
        let refused =
            |error: InputError| Problem::usage(error.to_string(), "see `crossbar all-frequency factor --help`");
        Ok((name, subject.map_err(refused)?))
    }
}

impl StudyArgs for Args {
    type Study = BrdfFactors;
    const QUICKER: &'static str = "fewer `--terms`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), self.table.iter().map(PathBuf::as_path).collect())
    }

    fn study(&self) -> miette::Result<BrdfFactors> {
        let (name, subject) = match &self.table {
            Some(path) => (path.display().to_string(), FactorSubject::Table(load_product_table(path)?)),
            None => {
                let (name, subject) = self.model(self.brdf.unwrap_or(ModelArg::CookTorrance))?;
                (name.to_owned(), subject)
            }
        };
        let sampling = FactorSampling { side: self.side as usize, ..FactorSampling::default() };
        Ok(BrdfFactors { name, subject, sampling, terms: self.terms.map(|terms| terms as usize) })
    }
}
