use welkin_runtime::SkyParams;
use welkin_runtime::params::{PerezShape, SkyModel};

use crate::cli::{Cli, Command};

fn read(args: &[&str]) -> Result<SkyParams, String> {
    let words = ["welkin-view", "render", "pack", "-o", "f.png"];
    match Cli::read(words.iter().chain(args)).map(|cli| cli.command) {
        Ok(Some(Command::Render(render))) => Ok(render.view().params),
        Ok(other) => panic!("{args:?}: {other:?}"),
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn a_model_is_chosen_by_name_and_shaped_by_its_options() {
    for model in SkyModel::ALL {
        let params = read(&["--sky", model.name()]).unwrap();
        let defaults = SkyParams::default();
        assert_eq!(
            params,
            SkyParams {
                sky: model,
                ..defaults
            }
        );
    }
    let of = |args: &[&str]| read(&[&["--sky", "perez"], args].concat()).unwrap().perez;
    assert_eq!(of(&["--turbidity", "4"]).turbidity, 4.0);
    assert_eq!(of(&["--cie", "12"]).shape, PerezShape::Cie(12));
    let custom = of(&["--perez", "-1,-0.3,10,-3,0.45"]).shape;
    assert_eq!(custom, PerezShape::Custom([-1.0, -0.3, 10.0, -3.0, 0.45]));
}

#[test]
fn options_of_the_other_model_are_refused() {
    for option in [
        ["--turbidity", "3"],
        ["--cie", "12"],
        ["--perez", "0,-1,0,-1,0"],
    ] {
        let error = read(&option).unwrap_err();
        let told = format!("{} belongs to --sky perez", option[0]);
        assert!(error.contains(&told), "{error}");
    }
    let error = read(&["--sky", "perez", "--cie", "5", "--turbidity", "3"]).unwrap_err();
    assert!(error.contains("--cie 5 is overcast and white"), "{error}");
    assert!(read(&["--sky", "perez", "--cie", "6", "--turbidity", "3"]).is_ok());
    let both = ["--sky", "perez", "--cie", "5", "--perez", "0,-1,0,-1,0"];
    assert!(read(&both).unwrap_err().contains("cannot be used with"));
}

#[test]
fn what_is_out_of_range_is_refused_with_the_range() {
    for (option, values, expected) in [
        (
            "--turbidity",
            ["1.6", "10.1", "nan"],
            "expected a number from 1.7 to 10",
        ),
        (
            "--cie",
            ["0", "16", "clear"],
            "expected a whole number from 1 to 15",
        ),
        (
            "--perez",
            ["1,-1,1,-1", "0,0,0,-1,0", "0,-1,nan,-1,0"],
            "expected five numbers: -1 to 10, -5 to -0.05, 0 to 30, -5 to -0.1, 0 to 2",
        ),
    ] {
        for value in values {
            let error = read(&["--sky", "perez", option, value]).unwrap_err();
            assert!(error.contains(expected), "{value}: {error}");
        }
    }
    let error = read(&["--sky", "hosek"]).unwrap_err();
    assert!(error.contains("table, perez"), "{error}");
}
