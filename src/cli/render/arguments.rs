//! The arguments of `volary render`, and how they make a scene look.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use volary::file::FileError;
use volary::picture::{FileKind, PictureError, Theme};
use volary::render::{Camera, Coloring, Layer, Layers, Look, RenderError, Size, Survey};

use crate::cli::drive::Threads;
use crate::cli::values::{Page, above_zero, camera, number, size, turn, window};
use crate::cli::{Refusal, files};

const EXAMPLES: &str = "\
Examples:
  volary render run.jsonl -o last.png
  volary render run.jsonl -o strip.svg --at 0,8.5,17,28
  volary render run.jsonl -o film.mp4 --color speed --trail 3 --theme dark
  volary render run.jsonl -o film.gif --follow --show velocities,edges --hide legend
  volary render space.jsonl -o round.webm --camera 30,20 --orbit 12

The name of the file tells what is drawn: .svg and .png one moment, the last where none is
named, or several beside each other; .gif, .apng, .mp4 and .webm a film. What is drawn at a time
is the nearest frame of the trace: between frames nothing is made up.

Layers: grid, shadows, obstacles, targets, view, trails, edges, blocked, beta, gamma, velocities,
bodies, headings, contacts, time, scale, legend. Shown where nothing else is said: obstacles,
targets, bodies, headings, contacts, time, scale, legend, edges where the trace has them, in
space also grid and shadows.";

/// Arguments of `volary render`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(in crate::cli) struct RenderArguments {
    /// The trace
    pub(super) trace: PathBuf,
    /// The file to write: .svg, .png, .gif, .apng, .mp4 or .webm
    #[arg(short, long, value_name = "FILE")]
    pub(super) out: PathBuf,
    /// Moments to draw
    #[arg(
        long,
        value_name = "TIME,…",
        value_parser = number,
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    pub(super) at: Vec<f64>,
    /// Draw all moments in one scene, each in a colour of its own
    #[arg(long, requires = "at", conflicts_with = "color")]
    pub(super) overlay: bool,
    /// Time at which a film begins
    #[arg(long, value_name = "TIME", value_parser = number, allow_negative_numbers = true)]
    pub(super) from: Option<f64>,
    /// Time at which a film ends
    #[arg(long, value_name = "TIME", value_parser = number, allow_negative_numbers = true)]
    pub(super) to: Option<f64>,
    /// Time between the pictures of a film; when absent as much as makes the film 20 seconds
    /// long at most
    #[arg(
        long,
        value_name = "TIME",
        value_parser = above_zero,
        allow_negative_numbers = true,
        conflicts_with = "speed"
    )]
    pub(super) every: Option<f64>,
    /// Time that passes in a second of film, instead of --every
    #[arg(long, value_name = "TIME", value_parser = above_zero, allow_negative_numbers = true)]
    pub(super) speed: Option<f64>,
    /// Pictures per second of a film, 25 when absent
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=100),
        allow_negative_numbers = true
    )]
    pub(super) fps: Option<u32>,
    /// Layers to show besides the usual ones
    #[arg(long, value_name = "LAYER,…", value_delimiter = ',')]
    pub(super) show: Vec<String>,
    /// Layers to hide
    #[arg(long, value_name = "LAYER,…", value_delimiter = ',')]
    pub(super) hide: Vec<String>,
    /// Layers to show, and no others
    #[arg(long, value_name = "LAYER,…", value_delimiter = ',', conflicts_with_all = ["show", "hide"])]
    pub(super) only: Vec<String>,
    /// Show where bodies came along in this time
    #[arg(long, value_name = "TIME", value_parser = above_zero, allow_negative_numbers = true)]
    pub(super) trail: Option<f64>,
    /// What the colours of bodies tell
    #[arg(long, value_enum, default_value_t = Colors::Group)]
    pub(super) color: Colors,
    /// The colours of the page
    #[arg(long, value_enum, default_value_t = Page::Light)]
    pub(super) theme: Page,
    /// Width and height in pixels, below 300x200 without legend and scale; when absent at most
    /// 800x600, or 1.4 times that for several moments
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(super) size: Option<[f64; 2]>,
    /// In 2-D: what is seen, as xmin,ymin,xmax,ymax; everything when absent
    #[arg(long, value_name = "BOX", value_parser = window, allow_hyphen_values = true)]
    pub(super) view: Option<[[f64; 2]; 2]>,
    /// Keep the flock in the middle
    #[arg(long)]
    pub(super) follow: bool,
    /// In 3-D: where it is seen from, as azimuth,elevation in degrees
    #[arg(long, value_name = "ANGLES", value_parser = camera, allow_hyphen_values = true)]
    pub(super) camera: Option<[f64; 2]>,
    /// In 3-D: degrees by which the camera goes round in a second of film
    #[arg(long, value_name = "DEGREES", value_parser = turn, allow_negative_numbers = true)]
    pub(super) orbit: Option<f64>,
    #[command(flatten)]
    pub(super) threads: Threads,
    /// Overwrite a file that exists
    #[arg(long)]
    pub(super) force: bool,
    /// Print nothing but errors
    #[arg(long)]
    pub(super) quiet: bool,
}

/// The most moments beside each other.
const PANELS: usize = 60;

/// What the colours of bodies tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Colors {
    /// The group
    Group,
    /// The speed
    Speed,
    /// The component of the proximity net
    Component,
    /// The heading
    Heading,
}

impl RenderArguments {
    /// Refuses options that the kind of file has no use for.
    pub(super) fn check(&self, films: bool) -> Result<(), Refusal> {
        let unfit = match films {
            false => [
                ("--from", self.from.is_some()),
                ("--to", self.to.is_some()),
                ("--every", self.every.is_some()),
                ("--speed", self.speed.is_some()),
                ("--fps", self.fps.is_some()),
                ("--orbit", self.orbit.is_some()),
            ]
            .to_vec(),
            true => vec![("--at", !self.at.is_empty())],
        };
        let most = match self.overlay {
            true => Theme::LIGHT.palette.len(),
            false => PANELS,
        };
        if self.at.len() > most {
            let (count, how) = (self.at.len(), if self.overlay { "over" } else { "beside" });
            return Err(Refusal::bad_input(format!(
                "--at names {count} moments; at most {most} are drawn {how} each other"
            )));
        }
        match unfit.iter().find(|(_, given)| *given) {
            None => Ok(()),
            Some((option, _)) => Err(Refusal::bad_input(match films {
                false => format!("{option} is for films: {}", FileKind::FILMS),
                true => format!(
                    "{option} is for stills, {}; films have --from",
                    FileKind::STILLS
                ),
            })),
        }
    }

    /// Refuses options that worlds of this dimension have no use for.
    pub(super) fn check_dimension(&self, dimension: usize) -> Result<(), Refusal> {
        let plane = [
            ("--camera", self.camera.is_some()),
            ("--orbit", self.orbit.is_some()),
        ];
        let space = [("--view", self.view.is_some()), ("--overlay", self.overlay)];
        let (unfit, why) = match dimension {
            2 => (plane, "is for worlds in 3-D, and this one is flat"),
            _ => (space, "is for worlds in 2-D, and this one is in space"),
        };
        match unfit.iter().find(|(_, given)| *given) {
            None => Ok(()),
            Some((option, _)) => Err(Refusal::bad_input(format!("{option} {why}"))),
        }
    }

    /// Pictures in a second of film.
    pub(super) fn rate(&self) -> u32 {
        self.fps.unwrap_or(25)
    }

    pub(super) fn refuse(&self, error: RenderError) -> Refusal {
        match error {
            RenderError::Trace(error) => Refusal::bad_input(error),
            RenderError::Picture(PictureError::File(
                error @ (FileError::Exists { .. } | FileError::BadPath { .. }),
            )) => files::refuse_file(error),
            RenderError::Picture(error @ PictureError::NoFfmpeg { .. }) => {
                Refusal::bad_input(error)
            }
            RenderError::Picture(error) => Refusal::failed(error),
            RenderError::Stopped => Refusal::failed(error),
            error => Refusal::bad_input(format!("{}: {error}", self.trace.display())),
        }
    }

    /// What is shown.
    pub(super) fn layers<const D: usize>(&self, survey: &Survey<D>) -> Result<Layers, Refusal> {
        let parse = |names: &[String]| {
            let layers = names.iter().map(|name| name.parse());
            layers
                .collect::<Result<Vec<Layer>, _>>()
                .map_err(Refusal::bad_input)
        };
        let (only, show, hide) = (parse(&self.only)?, parse(&self.show)?, parse(&self.hide)?);
        let mut layers = match only.is_empty() {
            true => Layers::usual(survey),
            false => only.into_iter().collect(),
        };
        if self.trail.is_some() {
            layers.show(Layer::Trails);
        }
        show.into_iter().for_each(|layer| layers.show(layer));
        hide.into_iter().for_each(|layer| layers.hide(layer));
        Ok(layers)
    }

    pub(super) fn look<const D: usize>(&self, survey: &Survey<D>) -> Result<Look, Refusal> {
        let usual = Look::default();
        let [azimuth, elevation] = self
            .camera
            .unwrap_or([usual.camera.azimuth, usual.camera.elevation]);
        Ok(Look {
            theme: self.theme.theme(),
            coloring: match self.color {
                Colors::Group => Coloring::Group,
                Colors::Speed => Coloring::Speed,
                Colors::Component => Coloring::Component,
                Colors::Heading => Coloring::Heading,
            },
            layers: Some(self.layers(survey)?),
            size: self.size.map_or(usual.size, Size::Exact),
            window: self.view,
            follow: self.follow,
            camera: Camera {
                azimuth,
                elevation,
                orbits: self.orbit.is_some(),
            },
        })
    }

    /// Refuses a time that the trace does not hold.
    pub(super) fn within(
        &self,
        option: &str,
        time: f64,
        [first, last]: [f64; 2],
    ) -> Result<f64, Refusal> {
        // Times as they are printed are rounded.
        let slack = 1e-6 * (1.0 + last.abs());
        match (first - slack..=last + slack).contains(&time) {
            true => Ok(time),
            false => Err(Refusal::bad_input(format!(
                "{option} {time}: {} holds times from {first} to {last}",
                self.trace.display()
            ))),
        }
    }
}
