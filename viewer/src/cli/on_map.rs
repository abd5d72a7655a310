//! What does not go with a map of the whole sky.

/// What is given and belongs to one camera, and why a map has nothing of it.
pub fn stray_on_map(
    is_cube: bool,
    is_given: impl Fn(&str) -> bool,
    rain: f32,
    flare: f32,
) -> Option<(&'static str, &'static str)> {
    let sized = match is_cube {
        false => "its own number is its width",
        true => "its own number is the side of a face",
    };
    let cases = [
        ("size", true, sized),
        ("elevation", true, "it looks everywhere"),
        ("fov", true, "it looks everywhere"),
        (
            "azimuth",
            is_cube,
            "its faces look along the axes of the world",
        ),
        (
            "flare",
            flare > 0.0,
            "a lens flare belongs to one camera, and is left out",
        ),
        (
            "starburst",
            true,
            "a lens flare belongs to one camera, and is left out",
        ),
        (
            "rain",
            rain > 0.0,
            "streaks of rain belong to one screen and do not meet across faces",
        ),
        (
            "shadow",
            true,
            "shadows on the ground are drawn with a frame of their own",
        ),
    ];
    let stray = cases
        .iter()
        .find(|(option, matters, _)| *matters && is_given(option));
    stray.map(|(option, _, why)| (*option, *why))
}
