mod clear_sky;
mod date;
mod lit;
mod weather;

use clap::Command;
use welkin_runtime::params::FbmParams;

use super::*;

#[test]
fn every_setting_with_an_option_is_at_the_command_line() {
    let command = SettingArgs::augment_args(Command::new("render"));
    for key in KEYS {
        let Some(option) = key.option() else {
            continue;
        };
        let arg = command.get_arguments().find(|arg| arg.get_id() == option);
        assert_eq!(arg.and_then(Arg::get_long), Some(option));
    }
}

#[test]
fn the_stormy_palette_is_told_as_it_is() {
    let sharpness = FbmParams::STORMY.sharpness;
    let (_, keys) = options()
        .into_iter()
        .find(|(o, _)| *o == "sharpness")
        .unwrap();
    let told = format!("{sharpness} with the stormy palette]");
    assert!(help(&keys).ends_with(&told), "{}", help(&keys));
}
