//! `welkin model`: a cloud of a pack's field as a model that an artist edits.

use anyhow::{Result, bail};
use welkin_baker::cloud_model;
use welkin_pack::place::verify_apart;

use super::{ModelArgs, file, input};

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
