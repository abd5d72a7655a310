//! The labels of a picture: what is drawn for them beside it, and what becomes of that.

use anyhow::{Result, ensure};
use serde::Serialize;
use welkin_runtime::{Camera, SkyLight};
use welkin_viewer::frame::Frame;
use welkin_viewer::gpu::{Gpu, GpuError};
use welkin_viewer::headless::{Back, Begun, View};
use welkin_viewer::labels::{LightTold, Opacity, Projection, Seen, dome, oktas, sun_and_moon};
use welkin_viewer::save::{Format, encode};

use super::super::artist::Artist;
use crate::cli::{Label, Shot};
use crate::job::Job;

/// What is drawn for labels, begun or come back.
pub struct Drawn<F> {
    labels: Vec<Label>,
    view: View,
    projection: Option<Projection>,
    opacity: Option<Sheet<F>>,
    dome: Vec<(Camera, F)>,
    light: Option<SkyLight>,
    asked_oktas: Option<f32>,
}

/// A picture of opacity.
enum Sheet<F> {
    Frame(F),
    Map(Frame),
}

/// Labels in numbers.
#[derive(Debug, Default, Serialize)]
pub struct Told {
    #[serde(skip_serializing_if = "Option::is_none")]
    sun: Option<Seen>,
    #[serde(skip_serializing_if = "Option::is_none")]
    moon: Option<Seen>,
    #[serde(skip_serializing_if = "Option::is_none")]
    oktas: Option<Oktas>,
    #[serde(skip_serializing_if = "Option::is_none")]
    light: Option<LightTold>,
}

/// Eighths of cloud.
#[derive(Debug, Serialize)]
struct Oktas {
    /// As the job asked for, on average over moments.
    asked: Option<f32>,
    /// Of this sky.
    drawn: f32,
}

/// A label that is a picture.
pub struct Picture {
    /// What it is.
    pub label: Label,
    /// Bytes of a PNG.
    pub bytes: Vec<u8>,
}

/// That the labels are for what a job draws.
pub fn verify(labels: &[Label], shot: Shot) -> Result<()> {
    let is_cube = matches!(shot, Shot::Ktx2(_) | Shot::Faces(..));
    let of_pixels = [Label::Opacity, Label::Mask, Label::Sun];
    let stray = labels.iter().find(|label| of_pixels.contains(label));
    if let Some(label) = stray.filter(|_| is_cube) {
        ensure!(
            !is_cube,
            "cubemap does not go with --labels {}, which is told of the pixels of one picture; take equirect, or leave the label out",
            label.name()
        );
    }
    Ok(())
}

impl Drawn<Begun> {
    /// Begins what the labels of a job want.
    pub fn begin(
        labels: &[Label],
        artist: &mut Artist<'_>,
        job: &Job,
        view: &View,
    ) -> Result<Drawn<Begun>, GpuError> {
        let has = |wanted: &[Label]| wanted.iter().any(|label| labels.contains(label));
        let azimuth_rad = job.azimuth_deg.to_radians();
        let projection = match job.shot {
            Shot::Frame(_) => Some(Projection::Frame(view.camera)),
            Shot::Equirect(width, _) => Some(Projection::Equirect(width, azimuth_rad)),
            Shot::Ktx2(_) | Shot::Faces(..) => None,
        };
        let opacity = match projection.filter(|_| has(&[Label::Opacity, Label::Mask, Label::Sun])) {
            None => None,
            Some(Projection::Frame(_)) => Some(Sheet::Frame(artist.begin_opacity(view)?)),
            Some(Projection::Equirect(width, azimuth_rad)) => Some(Sheet::Map(
                artist.equirect_opacity(view, width, azimuth_rad)?,
            )),
        };
        let mut faces = Vec::new();
        if has(&[Label::Oktas]) {
            for camera in dome(&view.camera) {
                let face = View {
                    camera,
                    ..view.clone()
                };
                faces.push((camera, artist.begin_opacity(&face)?));
            }
        }
        let light = match has(&[Label::Sun, Label::Light]) {
            true => Some(artist.light(view)?),
            false => None,
        };
        Ok(Drawn {
            labels: labels.to_vec(),
            view: view.clone(),
            projection,
            opacity,
            dome: faces,
            light,
            asked_oktas: job.oktas,
        })
    }

    /// Waits until all is there.
    pub fn wait(self, gpu: &Gpu) -> Result<Drawn<Back>, GpuError> {
        let opacity = match self.opacity {
            None => None,
            Some(Sheet::Map(map)) => Some(Sheet::Map(map)),
            Some(Sheet::Frame(frame)) => Some(Sheet::Frame(frame.wait(gpu)?)),
        };
        let faces = self.dome.into_iter();
        let faces = faces.map(|(camera, face)| Ok((camera, face.wait(gpu)?)));
        Ok(Drawn {
            labels: self.labels,
            view: self.view,
            projection: self.projection,
            opacity,
            dome: faces.collect::<Result<_, GpuError>>()?,
            light: self.light,
            asked_oktas: self.asked_oktas,
        })
    }
}

impl Drawn<Back> {
    /// The labels, those that are pictures and those that are numbers.
    pub fn finish(self) -> Result<(Vec<Picture>, Told)> {
        let opacity = match self.opacity {
            None => None,
            Some(Sheet::Map(map)) => Some(Opacity::of(&map)),
            Some(Sheet::Frame(frame)) => Some(Opacity::of(&frame.frame()?)),
        };
        let (mut pictures, mut told) = (Vec::new(), Told::default());
        for label in self.labels {
            let frame = match (label, &opacity, &self.light) {
                (Label::Opacity, Some(opacity), _) => opacity.picture(),
                (Label::Mask, Some(opacity), _) => opacity.mask(),
                (Label::Sun, Some(opacity), Some(light)) => {
                    if let Some(projection) = &self.projection {
                        let params = &self.view.params;
                        let [sun, moon] = sun_and_moon(params, light, projection, opacity);
                        (told.sun, told.moon) = (Some(sun), Some(moon));
                    }
                    continue;
                }
                (Label::Light, _, Some(light)) => {
                    told.light = Some(light.into());
                    continue;
                }
                // Oktas are below; for all others what they want is there.
                _ => continue,
            };
            let bytes = encode(&label.name(), Format::Png, &frame)?;
            pictures.push(Picture { label, bytes });
        }
        if !self.dome.is_empty() {
            let mut faces = Vec::new();
            for (camera, face) in self.dome {
                faces.push((camera, Opacity::of(&face.frame()?)));
            }
            told.oktas = Some(Oktas {
                asked: self.asked_oktas,
                drawn: oktas(&faces),
            });
        }
        Ok((pictures, told))
    }
}
