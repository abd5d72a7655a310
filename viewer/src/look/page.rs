//! A page of pictures that needs nothing else.

use std::fmt::Write;

use welkin_runtime::Method;

/// A picture of the page.
pub struct Picture {
    /// Beside the page.
    pub file: String,
    pub method: Method,
    pub scene: &'static str,
    /// Fine over coarse structure inside its clouds.
    pub structure: Option<f32>,
}

/// The page: a heading for each method, its skies, what is beyond the bounds.
pub fn html(pictures: &[Picture], problems: &[String]) -> String {
    let mut text = String::from(
        "<!doctype html>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>Skies</title>\n<style>body{font:16px system-ui;margin:1rem;background:#111;color:#ddd}\
         div{display:grid;grid-template-columns:repeat(auto-fill,minmax(20rem,1fr));gap:.5rem}\
         figure{margin:0}img{width:100%}</style>\n",
    );
    let mut last = None;
    for picture in pictures {
        if last != Some(picture.method) {
            let end = if last.is_some() { "</div>\n" } else { "" };
            let _ = write!(
                text,
                "{end}<h1>{}</h1>\n<p>{}</p>\n<div>\n",
                picture.method.name(),
                picture.method.title()
            );
            last = Some(picture.method);
        }
        let structure = picture
            .structure
            .map_or("no clouds to measure".into(), |n| {
                format!("structure {n:.2}, photographs 0.12 to 0.25")
            });
        let (file, scene) = (&picture.file, picture.scene);
        let _ = writeln!(
            text,
            "<figure><a href=\"{file}\"><img src=\"{file}\" alt=\"{scene}\" loading=\"lazy\"></a>\
             <figcaption>{scene}: {structure}</figcaption></figure>"
        );
    }
    text.push_str(if last.is_some() { "</div>\n" } else { "" });
    if !problems.is_empty() {
        text.push_str("<h1>Beyond the bounds</h1>\n<ul>\n");
        for problem in problems {
            let _ = writeln!(text, "<li>{problem}</li>");
        }
        text.push_str("</ul>\n");
    }
    text
}
