//! A page of pictures that needs nothing else.

use std::fmt::Write;

use welkin_runtime::Method;

/// What the page shows of a method.
pub struct Shown {
    pub method: Method,
    /// How it moves, in a sentence.
    pub motion: Option<String>,
    pub pictures: Vec<Picture>,
}

/// A picture of the page.
pub struct Picture {
    /// Beside the page.
    pub file: String,
    pub scene: &'static str,
    /// Fine over coarse structure inside its clouds.
    pub structure: Option<f32>,
}

/// The page: a heading for each method, its skies, what is beyond the bounds.
pub fn html(methods: &[Shown], problems: &[String]) -> String {
    let mut text = String::from(
        "<!doctype html>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>Skies</title>\n<style>body{font:16px system-ui;margin:1rem;background:#111;color:#ddd}\
         div{display:grid;grid-template-columns:repeat(auto-fill,minmax(20rem,1fr));gap:.5rem}\
         figure{margin:0}img{width:100%}</style>\n",
    );
    for shown in methods {
        let (name, title) = (shown.method.name(), shown.method.title());
        let _ = writeln!(text, "<h1>{name}</h1>\n<p>{title}</p>");
        if let Some(motion) = &shown.motion {
            let _ = writeln!(text, "<p>{motion}</p>");
        }
        text.push_str("<div>\n");
        for picture in &shown.pictures {
            text.push_str(&figure(picture));
        }
        text.push_str("</div>\n");
    }
    if !problems.is_empty() {
        text.push_str("<h1>Beyond the bounds</h1>\n<ul>\n");
        for problem in problems {
            let _ = writeln!(text, "<li>{problem}</li>");
        }
        text.push_str("</ul>\n");
    }
    text
}

fn figure(picture: &Picture) -> String {
    let structure = picture
        .structure
        .map_or("no clouds to measure".into(), |n| {
            format!("structure {n:.2}, photographs 0.12 to 0.25")
        });
    let (file, scene) = (&picture.file, picture.scene);
    format!(
        "<figure><a href=\"{file}\"><img src=\"{file}\" alt=\"{scene}\" loading=\"lazy\"></a>\
         <figcaption>{scene}: {structure}</figcaption></figure>\n"
    )
}
