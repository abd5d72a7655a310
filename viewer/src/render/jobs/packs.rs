//! The packs that jobs are drawn of: each is opened once, and stays open.

use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};
use welkin_pack::Pack;
use welkin_pack::place::verify_apart;
use welkin_runtime::{Method, Oktas, SkyError};
use welkin_viewer::gpu::Gpu;

use super::super::artist::Artist;

/// The packs that were opened.
pub struct Packs<'a> {
    gpu: &'a Gpu,
    /// Where pictures go.
    output: &'a Path,
    opened: Vec<Opened<'a>>,
}

/// A pack that is open, and its sky.
pub struct Opened<'a> {
    path: PathBuf,
    /// The last part of its folder's name.
    pub name: String,
    /// The manifest's, which stands for all of it.
    pub seal: String,
    pub calibration: Oktas,
    pub artist: Artist<'a>,
    has_field: bool,
}

impl<'a> Packs<'a> {
    pub fn new(gpu: &'a Gpu, output: &'a Path) -> Packs<'a> {
        Packs {
            gpu,
            output,
            opened: Vec::new(),
        }
    }

    /// The pack of a folder.
    pub fn get(&mut self, path: &Path) -> Result<&mut Opened<'a>> {
        let found = self.opened.iter().position(|opened| opened.path == path);
        let place = match found {
            Some(place) => place,
            None => {
                verify_apart(&[path], &[self.output])?;
                self.opened.push(Opened::open(self.gpu, path)?);
                self.opened.len() - 1
            }
        };
        Ok(&mut self.opened[place])
    }
}

impl<'a> Opened<'a> {
    fn open(gpu: &'a Gpu, path: &Path) -> Result<Opened<'a>> {
        let pack = Pack::open(path)?;
        let name = path.file_name().unwrap_or_default();
        Ok(Opened {
            path: path.to_path_buf(),
            name: name.to_string_lossy().into_owned(),
            seal: pack.manifest().seal.clone(),
            calibration: Oktas::new(&pack)?,
            has_field: pack.field().is_some(),
            artist: Artist::new(gpu, pack),
        })
    }

    /// That it has what a method draws from.
    pub fn verify(&self, method: Method) -> Result<()> {
        ensure!(
            method != Method::Sprites || self.has_field,
            "{}: {}",
            self.path.display(),
            SkyError::MissingField
        );
        Ok(())
    }
}
