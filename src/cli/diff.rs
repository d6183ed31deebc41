//! `crossbar diff`: the difference of two pictures.

use std::path::{Path, PathBuf};

use super::study::{StudyArgs, StudyFiles};
use super::view;
use crate::study::picture_difference::{DifferenceOptions, PictureDifference, PictureInput};

const EXAMPLES: &str = "\
Examples:
  crossbar diff docs/examples/exact.png docs/examples/leaky.png       # exit code 1
      each channel's rms difference, and its largest difference with the pixel; SSIM; FLIP
  crossbar diff docs/examples/smooth.exr docs/examples/rough.exr --out out/changes      # exit code 1
      the pixels that brightened and that darkened, in false colours; difference.exr has the differences as numbers
  crossbar diff docs/examples/smooth.exr docs/examples/rough.exr --channel R --exposure 2 --max-flip 0.5
      a check: is the mean FLIP at most 0.5, at twice the exposure of the files?

Channels are compared as they are stored. If one picture is encoded for a screen (PNG) and the \
other is linear (EXR, HDR), the encoded picture is decoded first. NaN equals NaN. SSIM and FLIP \
compare the two pictures as a screen shows them.
Written to --out: index.html (self-contained), difference.png, flip.png, first.png, second.png, \
difference.exr, channels.csv, study.json. docs/diff.md explains each figure.

Exit codes: 0 the pictures are equal, or within all given bounds; 1 they are not; 2 they cannot be compared.";

/// Compare two pictures (PNG, EXR, HDR): sample by sample, and as a viewer perceives them
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The first picture
    #[arg(value_name = "A")]
    first: PathBuf,

    /// The second picture; differences are this picture minus the first
    #[arg(value_name = "B")]
    second: PathBuf,

    #[command(flatten)]
    options: DifferenceOptions,

    /// Write the maps of differences, the page and the tables to this folder [default: write nothing]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl StudyArgs for Args {
    type Study = PictureDifference;

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(self.out.as_deref(), vec![&self.first, &self.second])
    }

    fn study(&self) -> miette::Result<PictureDifference> {
        let read = |path: &Path| -> miette::Result<PictureInput> {
            Ok(PictureInput { name: path.display().to_string(), picture: view::picture(path)? })
        };
        let pictures = [read(&self.first)?, read(&self.second)?];
        Ok(PictureDifference { pictures, options: self.options.clone(), maps: self.out.is_some() })
    }
}
