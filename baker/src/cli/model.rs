//! `welkin model`: a cloud of a pack's field as a model that an artist edits.

use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use welkin_baker::cloud_model;
use welkin_pack::place::verify_apart;

use super::{file, input};

#[derive(Debug, Args)]
pub struct ModelArgs {
    /// Folder of the pack
    pack: PathBuf,
    /// Number of the cloud in the field, from 0, in the order of their ranks
    #[arg(long, value_name = "N", default_value_t = 0)]
    cloud: usize,
    /// Binary glTF to write; a file of that name is replaced
    #[arg(short, long, value_name = "CLOUD.glb")]
    output: PathBuf,
}

pub fn run(args: &ModelArgs) -> Result<()> {
    verify_apart(&[&args.pack], &[&args.output])?;
    let pack = input::pack(&args.pack)?;
    let Some(field) = pack.field() else {
        bail!(
            "{}: the pack has no field, so there is no cloud to write; bake one with a table [field] in its recipe",
            args.pack.display()
        );
    };
    let Some(cloud) = field.clouds.get(args.cloud) else {
        bail!(
            "--cloud is {}, expected a number from 0 to {}: the field has {} clouds",
            args.cloud,
            field.clouds.len().saturating_sub(1),
            field.clouds.len()
        );
    };
    file::write(&args.output, &cloud_model(cloud))
}
