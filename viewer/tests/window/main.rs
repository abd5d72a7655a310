//! The window, driven as a person drives it: real keys and a real pointer on a display of its own (Xvfb), drawn by whatever
//! adapter there is (software Vulkan will do). Time stands in these skies, so that two pictures of one sky are the same.

#![cfg(target_os = "linux")]
// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;
mod desktop;

use std::path::Path;

use welkin_controls::{KEYS, Preset, Settings};
use welkin_pack::Pack;

use common::{RECIPE, failed, pack, run, view};
use desktop::{Desktop, PANEL_PX, Program, SIZE_PX, Screen, eventually};

/// A window on a pack, its settings in `sky.toml`, time standing.
fn open<'a>(desktop: &'a Desktop, words: &[&str]) -> Program<'a> {
    std::fs::write(desktop.file("sky.toml"), "rate = 0\n").unwrap();
    let program = desktop.start(words);
    eventually("the sky is on the screen", || desktop.screen().is_sky());
    program
}

/// The settings, saved by the key.
fn saved(desktop: &Desktop, program: &Program) -> Settings {
    let file = desktop.file("sky.toml");
    std::fs::write(&file, "").unwrap();
    program.key("ctrl+s");
    let mut text = String::new();
    eventually("the settings are saved", || {
        text = std::fs::read_to_string(&file).unwrap();
        !text.is_empty()
    });
    Settings::from_toml(&text).unwrap()
}

#[test]
fn keys_choose_methods_and_weathers_and_turn_and_fly() {
    let desktop = Desktop::new();
    let program = open(&desktop, &[pack().to_str().unwrap()]);
    let mut before = desktop.screen();
    for (key, method) in [
        ("2", "octaves"),
        ("3", "fbm"),
        ("4", "lit"),
        ("5", "sprites"),
        ("1", "packed"),
    ] {
        program.key(key);
        eventually("the method changes the picture", || {
            desktop.screen().sky_differs(&before)
        });
        assert_eq!(saved(&desktop, &program).params.method.name(), method);
        before = desktop.screen();
    }
    program.key("F5");
    eventually("the storm has come", || {
        Preset::named("storm")
            .unwrap()
            .is(&saved(&desktop, &program))
    });
    let view = saved(&desktop, &program).view;
    program.hold("Right");
    eventually("the view turns", || {
        saved(&desktop, &program).view.azimuth_deg != view.azimuth_deg
    });
    assert_eq!(saved(&desktop, &program).view.up_m, view.up_m);
    program.key("f");
    program.hold("e");
    eventually("the viewer rises", || {
        saved(&desktop, &program).view.up_m > view.up_m
    });
    // They are loaded once the picture is theirs.
    let before = desktop.screen();
    std::fs::write(desktop.file("sky.toml"), "rate = 0\ncover = 0.125\n").unwrap();
    program.key("ctrl+o");
    eventually("the settings are loaded", || {
        desktop.screen().sky_differs(&before)
    });
    assert_eq!(saved(&desktop, &program).params.cover, 0.125);
    program.key("h");
    eventually("the panel is gone", || !desktop.screen().has_panel());
}

#[test]
fn the_pointer_moves_every_slider_of_the_paper_and_turns_the_view() {
    let desktop = Desktop::new();
    let program = open(&desktop, &[pack().to_str().unwrap()]);
    let defaults = saved(&desktop, &program);
    // A save is carried out after all that came before it was drawn.
    let seen = || assert_eq!(saved(&desktop, &program).rate, 0.0);
    // Down the panel, a drag along each row: those of the six must answer, in the paper's order.
    let mut moved: Vec<&str> = Vec::new();
    let (mut before, mut row_px) = (defaults, 60);
    while moved.len() < 6 && row_px < 260 {
        program.drag([125, row_px], [185, row_px], seen);
        let now = saved(&desktop, &program);
        let changed = |key: &&welkin_controls::Key| key.text(&now) != key.text(&before);
        let names: Vec<&str> = KEYS.iter().filter(changed).map(|key| key.name).collect();
        assert!(names.len() <= 1, "one slider at a time: {names:?}");
        moved.extend(names.first().filter(|name| moved.last() != Some(name)));
        (before, row_px) = (now, row_px + 11);
    }
    let six: Vec<&str> = KEYS[..6].iter().map(|key| key.name).collect();
    assert_eq!(moved, six);
    // On the sky, the same drag turns the view and no slider.
    let middle = [(PANEL_PX + SIZE_PX[0]) / 2, SIZE_PX[1] / 2];
    program.drag(middle, [middle[0] - 100, middle[1]], seen);
    let turned = saved(&desktop, &program);
    let degrees = turned.view.azimuth_deg - before.view.azimuth_deg;
    assert!(degrees > 1.0, "{degrees}");
    assert_eq!(turned.params, before.params);
}

#[test]
fn a_picture_is_the_command_line_s_and_the_screen_s() {
    let desktop = Desktop::new();
    let program = open(&desktop, &[pack().to_str().unwrap()]);
    program.key("F3");
    eventually("broken clouds have come", || {
        Preset::named("broken")
            .unwrap()
            .is(&saved(&desktop, &program))
    });
    program.key("p");
    let picture = desktop.file("sky.png");
    eventually("the picture is saved", || picture.exists());
    program.key("c");
    let mut command = String::new();
    eventually("the command is copied", || {
        command = desktop.clipboard();
        command.starts_with("welkin-view render")
    });
    let again = desktop.file("again.png");
    let mut words: Vec<&str> = command.split(' ').skip(1).collect();
    let place = words.iter().position(|word| *word == "sky.png").unwrap();
    words[place] = again.to_str().unwrap();
    let drawn = run(view(&words));
    assert!(drawn.status.success(), "{command}: {drawn:?}");
    assert_eq!(
        std::fs::read(&picture).unwrap(),
        std::fs::read(&again).unwrap()
    );
    // The screen shows just these bytes: both are drawn into the same kind of target.
    let screen = desktop.screen();
    let picture = image::open(&picture).unwrap().into_rgb8();
    assert_eq!([picture.width(), picture.height()], SIZE_PX);
    let differs = |(at, colour): &([u32; 2], [u8; 3])| picture.get_pixel(at[0], at[1]).0 != *colour;
    assert_eq!(screen.sky_pixels().filter(differs).count(), 0);
}

#[test]
fn a_lost_device_is_opened_again_and_the_sky_stays() {
    let desktop = Desktop::new();
    let program = open(&desktop, &[pack().to_str().unwrap()]);
    let before = desktop.screen();
    assert_eq!(before.reddish_in_panel(), 0);
    program.key("ctrl+r");
    eventually("the loss is told", || {
        desktop.screen().reddish_in_panel() > 50
    });
    eventually("the sky is there as before", || {
        !desktop.screen().sky_differs(&before)
    });
    program.key("4");
    eventually("it can still be changed", || {
        desktop.screen().sky_differs(&before)
    });
    assert_eq!(saved(&desktop, &program).params.method.name(), "lit");
}

#[test]
fn a_saved_recipe_is_baked_and_shown_and_a_broken_one_is_told() {
    let desktop = Desktop::new();
    let (recipe, folder) = (desktop.file("r.toml"), desktop.file("pack"));
    std::fs::write(&recipe, RECIPE).unwrap();
    let words = [
        folder.to_str().unwrap(),
        "--watch",
        recipe.to_str().unwrap(),
    ];
    let _program = open(&desktop, &words);
    let seed = |folder: &Path| Some(Pack::open(folder).ok()?.manifest().seed);
    eventually("the pack is written", || seed(&folder).is_some());
    let first = settled(&desktop);
    std::fs::write(&recipe, format!("seed = 77\n{RECIPE}")).unwrap();
    eventually("the new sky is shown", || {
        let screen = desktop.screen();
        assert!(screen.is_sky(), "no frame is black: {:?}", screen.darkest());
        screen.sky_differs(&first)
    });
    assert_eq!(seed(&folder), Some(77));
    let second = settled(&desktop);
    assert_eq!(second.reddish_in_panel(), 0);
    std::fs::write(&recipe, format!("sede = 78\n{RECIPE}")).unwrap();
    eventually("the error is shown", || {
        desktop.screen().reddish_in_panel() > 50
    });
    assert!(!desktop.screen().sky_differs(&second), "the old sky stays");
    assert_eq!(seed(&folder), Some(77));
    std::fs::write(&recipe, format!("seed = 78\n{RECIPE}")).unwrap();
    eventually("the error is gone once it is mended", || {
        let screen = desktop.screen();
        screen.reddish_in_panel() == 0 && screen.sky_differs(&second)
    });
}

/// The screen once it does not change any more: a pack that is written is shown when its shaders are compiled.
fn settled(desktop: &Desktop) -> Screen {
    const AT_REST: u32 = 4;
    let (mut last, mut same) = (desktop.screen(), 0);
    eventually("the screen is at rest", || {
        std::thread::sleep(std::time::Duration::from_millis(700));
        let now = desktop.screen();
        same = if now.differs(&last) { 0 } else { same + 1 };
        last = now;
        same == AT_REST
    });
    last
}

#[test]
fn a_dropped_photograph_becomes_the_photo_channel() {
    let desktop = Desktop::new();
    let photo = desktop.file("a photograph.png");
    let built_in = "../assets-src/photos/god-rays-1024.png";
    image::open(built_in)
        .unwrap()
        .rotate90()
        .save(&photo)
        .unwrap();
    let program = open(&desktop, &[pack().to_str().unwrap()]);
    let before = settled(&desktop);
    program.drop_file(&photo);
    eventually("the clouds are of the photograph", || {
        desktop.screen().sky_differs(&before)
    });
    let broken = desktop.file("broken.png");
    std::fs::write(&broken, "no picture").unwrap();
    let with_photo = settled(&desktop);
    program.drop_file(&broken);
    eventually("what is no picture is told", || {
        desktop.screen().reddish_in_panel() > 50
    });
    assert!(
        !desktop.screen().sky_differs(&with_photo),
        "the old sky stays"
    );
}

#[test]
fn a_pack_that_is_dropped_while_a_recipe_is_watched_is_never_written_to() {
    let desktop = Desktop::new();
    let (recipe, folder) = (desktop.file("r.toml"), desktop.file("pack"));
    std::fs::write(&recipe, RECIPE).unwrap();
    let words = [
        folder.to_str().unwrap(),
        "--watch",
        recipe.to_str().unwrap(),
    ];
    let program = open(&desktop, &words);
    let seed = |folder: &Path| Some(Pack::open(folder).ok()?.manifest().seed);
    eventually("the pack is written", || seed(&folder).is_some());
    let first = settled(&desktop);
    let other = common::bake("other", &format!("seed = 5\n{RECIPE}"), None);
    program.drop_file(&other);
    eventually("the other pack is shown", || {
        desktop.screen().sky_differs(&first)
    });
    std::fs::write(&recipe, format!("seed = 77\n{RECIPE}")).unwrap();
    eventually("the recipe is baked into its own pack", || {
        seed(&folder) == Some(77)
    });
    assert_eq!(seed(&other), Some(5));
}

/// Hills in the lower half, the sky above; keys turn the hours and choose methods.
#[test]
fn the_example_draws_a_scene_under_its_sky() {
    let desktop = Desktop::new();
    let program = desktop.example("window");
    eventually("the hills are on the screen", || {
        let screen = desktop.screen();
        let [above, below] = [0..200, 400..600].map(|rows| screen.mean(rows));
        // Blue above, the green and brown of the ground below.
        above[2] > above[0] + 10.0 && below[2] < below[1] && below[1] > 20.0
    });
    for key in ["Left", "Up", "2"] {
        let before = desktop.screen();
        eventually("the key changes the picture", || {
            program.key(key);
            desktop.screen().sky_differs(&before)
        });
    }
}

#[test]
fn without_a_library_of_the_keyboard_it_says_which_package_has_it() {
    let desktop = Desktop::new();
    for (file, package) in [
        ("libxkbcommon-x11.so.0", "libxkbcommon-x11-0"),
        ("libxkbcommon.so.0", "libxkbcommon0"),
        ("libXcursor.so.1", "libxcursor1"),
    ] {
        // What the loader finds first is no library.
        let damaged = tempfile::tempdir().unwrap();
        std::fs::write(damaged.path().join(file), "no library").unwrap();
        let mut command = view(&[pack().to_str().unwrap()]);
        command
            .env("DISPLAY", desktop.name())
            .env("LD_LIBRARY_PATH", damaged.path());
        failed(&run(command), 1, &[package, "apt-get install"]);
    }
}

#[test]
fn without_a_display_or_an_adapter_it_says_what_to_do() {
    let mut command = view(&[pack().to_str().unwrap()]);
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    failed(&run(command), 1, &["no display", "welkin-view render"]);
    let desktop = Desktop::new();
    let mut command = view(&[pack().to_str().unwrap()]);
    command
        .env("DISPLAY", desktop.name())
        .env("WGPU_ADAPTER_NAME", "no such thing");
    failed(&run(command), 1, &["no such thing", "WGPU_ADAPTER_NAME"]);
    let mut command = view(&[pack().to_str().unwrap()]);
    command
        .env("DISPLAY", desktop.name())
        .env("WGPU_BACKEND", "vulkan")
        .env("VK_ICD_FILENAMES", "/nonexistent.json")
        .env("VK_DRIVER_FILES", "/nonexistent.json");
    failed(
        &run(command),
        1,
        &["no graphics adapter", "mesa-vulkan-drivers"],
    );
}

#[test]
fn what_cannot_be_read_is_told_before_a_window_opens() {
    failed(&run(view(&["no/such/pack"])), 1, &["no/such/pack"]);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sky.toml");
    std::fs::write(&file, "cover = 3").unwrap();
    let words = [
        pack().to_str().unwrap(),
        "--settings",
        file.to_str().unwrap(),
    ];
    failed(
        &run(view(&words)),
        1,
        &["sky.toml", "cover is \"3\"", "from 0 to 1"],
    );
}
