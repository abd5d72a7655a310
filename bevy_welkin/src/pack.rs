//! A pack as an asset: the manifest is loaded by its path, the other files from the folder that it lies in.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::asset::io::Reader;
use bevy::asset::{AssetLoader, AssetPath, LoadContext, ReadAssetBytesError};
use bevy::prelude::*;
use welkin_pack::manifest::MANIFEST_FILE;
use welkin_pack::{Manifest, Pack, PackError};
use welkin_runtime::{PackLight, SkyError};

/// A verified pack. As one of its files changes, it is loaded anew, if Bevy watches files; the sky follows.
#[derive(Asset, TypePath, Clone, Debug)]
pub struct WelkinPack {
    pub(crate) pack: Arc<Pack>,
    pub(crate) light: Arc<PackLight>,
}

impl WelkinPack {
    /// A pack that was baked or read by other means.
    ///
    /// # Errors
    /// See [`PackLight::new`].
    pub fn new(pack: Pack) -> Result<WelkinPack, SkyError> {
        Ok(WelkinPack {
            light: Arc::new(PackLight::new(&pack)?),
            pack: Arc::new(pack),
        })
    }

    /// The pack itself.
    pub fn pack(&self) -> &Pack {
        &self.pack
    }

    /// What the light of its sky follows from.
    pub fn light(&self) -> &PackLight {
        &self.light
    }
}

/// Why a pack could not be loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WelkinPackError {
    /// The manifest could not be read.
    #[error("cannot read {MANIFEST_FILE}: {0}; load the path of the pack's {MANIFEST_FILE}")]
    Manifest(#[from] std::io::Error),
    /// A file that the manifest names could not be read.
    #[error(
        "cannot read {file}, which the manifest names: {error}; copy the whole folder of the pack"
    )]
    File {
        /// Its name in the pack's folder.
        file: String,
        /// Why.
        error: Box<ReadAssetBytesError>,
    },
    /// The files are no sound pack.
    #[error(transparent)]
    Pack(#[from] PackError),
    /// The pack has no sky.
    #[error(transparent)]
    Sky(#[from] SkyError),
}

/// Loads a [`WelkinPack`] by the path of its `pack.json`.
#[derive(TypePath, Clone, Copy, Debug, Default)]
pub struct WelkinPackLoader;

impl AssetLoader for WelkinPackLoader {
    type Asset = WelkinPack;
    type Settings = ();
    type Error = WelkinPackError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        _settings: &(),
        context: &mut LoadContext<'_>,
    ) -> Result<WelkinPack, WelkinPackError> {
        let manifest_path = context.path().clone();
        let place = manifest_path.parent().unwrap_or_default().to_string();
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await?;
        let mut files = BTreeMap::new();
        for file in Manifest::file_names(&manifest_path.to_string(), &bytes)? {
            let path = AssetPath::from(file.clone());
            let path = manifest_path.resolve_embed(&path);
            // Each file that is read here is watched with the manifest.
            let bytes =
                context
                    .read_asset_bytes(path)
                    .await
                    .map_err(|error| WelkinPackError::File {
                        file: file.clone(),
                        error: Box::new(error),
                    })?;
            files.insert(file, bytes);
        }
        files.insert(MANIFEST_FILE.to_string(), bytes);
        Ok(WelkinPack::new(Pack::from_memory(&place, &files)?)?)
    }

    fn extensions(&self) -> &[&str] {
        &["json"]
    }
}

pub(crate) fn build(app: &mut App) {
    app.init_asset::<WelkinPack>()
        .register_asset_loader(WelkinPackLoader);
}
