//! The page of packs whose texts are hostile and whose texels are broken.

use std::fs;

use welkin_baker::Recipe;
use welkin_pack::check::examine;
use welkin_pack::{Pack, Role};

use super::*;

/// A small pack with clouds in space.
const SMALL: &str = "[clouds]\nsize = 64\n[stars]\nsize = 64\ncount = 20\n[galaxy]\nsize = 32\n\
    [sky]\nsuns = 16\n[sun]\nsize = 16\n[fbm]\nsize = 64\ncells = 16\n[flares]\nsize = 64\n\
    [layers]\nsize = 64\n[sprites]\nsize = 128\n[field]\nsections = 1\n";

fn small() -> Examined {
    let resolved = Recipe::parse("small.toml", SMALL)
        .unwrap()
        .resolve(None)
        .unwrap();
    let proceed = |_| std::ops::ControlFlow::Continue(());
    let pack: Pack = welkin_baker::bake(&resolved, None, &proceed).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in pack.files() {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    examine(folder.path()).unwrap()
}

/// Tags that are opened and not closed, and whether all are closed in order. Void elements aside.
fn unclosed(html: &str) -> Vec<&str> {
    let mut open = Vec::new();
    for tag in html.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("a tag ends");
        let name = tag.split([' ', '/']).find(|part| !part.is_empty()).unwrap();
        match tag {
            _ if tag.ends_with('/') || ["!doctype", "meta"].contains(&name) => {}
            _ if tag.starts_with('/') => assert_eq!(open.pop(), Some(name), "</{name}>"),
            _ => open.push(name),
        }
    }
    open
}

#[test]
fn a_page_shows_every_channel_and_its_texts_are_no_markup() {
    let mut pack = small();
    let hostile = "</title><script>alert(1)</script><img src=x onerror='alert(2)'>\"";
    pack.manifest.name = hostile.to_string();
    pack.manifest.baker = hostile.to_string();
    pack.manifest.seal = hostile.to_string();
    for finding in &mut pack.report.findings {
        finding.note = hostile.to_string();
        finding.subject += hostile;
        finding.expected = hostile.to_string();
    }
    let html = html(&Page::of_pack(&pack)).unwrap();
    assert!(!html.contains("<script") && !html.contains("<img") && !html.contains(" onerror='"));
    assert!(html.contains("&lt;script&gt;alert(1)"));
    assert_eq!(unclosed(&html), [""; 0]);

    let pack = small();
    let html = super::html(&Page::of_pack(&pack)).unwrap();
    assert_eq!(unclosed(&html), [""; 0]);
    for outside in ["src=", "http://", "https://", "@import", "url(\""] {
        assert!(!html.contains(outside), "{outside}");
    }
    for (role, texture) in &pack.textures {
        for channel in role.spec().channels {
            let article = format!("<article id=\"{}-{}\">", role.name(), channel.name);
            let (_, after) = html.split_once(&article).expect(&article);
            let (article, _) = after.split_once("</article>").unwrap();
            let count = |what: &str| article.matches(what).count();
            // All layers of the clear sky are one picture.
            let layers = match role {
                Role::Sky => 1,
                _ => texture.layers as usize,
            };
            assert_eq!(count("aria-label=\"histogram\""), layers);
            let is_square = texture.width == texture.height;
            assert_eq!(
                count("aria-label=\"spectrum\"") > 0,
                is_square,
                "{role:?} {}",
                channel.name
            );
            assert_eq!(
                count("aria-label=\"level "),
                layers * (texture.levels.len() - 1)
            );
            let tiles = ["photo", "noise", "density", "octave1", "rate", "steps2"];
            assert!(count("2 by 2") == layers || !tiles.contains(&channel.name));
        }
    }
    // Every finding stands beside what it is about, and nowhere twice; those that failed stand on top, too.
    let findings = pack.report.findings.len() + pack.report.problems().count();
    assert_eq!(html.matches("<td class=\"mark\">").count(), findings);
    // Every cloud is on a plan once.
    let clouds = pack.field.as_ref().unwrap().clouds.len();
    let (_, plans) = html.split_once("class=\"plans\"").unwrap();
    let (plans, _) = plans.split_once("class=\"field\"").unwrap();
    assert_eq!(plans.matches("<rect class=\"kind").count(), clouds);
}

#[test]
fn what_failed_comes_first_and_is_marked_where_it_is_shown() {
    let mut pack = small();
    for finding in &mut pack.report.findings {
        if ["smooth", "cloud-cover", "seal"].contains(&finding.rule) {
            finding.outcome = Outcome::Failed;
        }
    }
    let errors = pack.report.findings.iter().filter(|f| f.is_error()).count();
    let (_, sky) = pack
        .textures
        .iter_mut()
        .find(|(role, _)| *role == Role::Sky)
        .unwrap();
    sky.levels[0][2..4].copy_from_slice(&0x7e00_u16.to_le_bytes());
    let html = html(&Page::of_pack(&pack)).unwrap();
    let (head, rest) = html.split_once("<section id=\"pack\">").unwrap();
    assert!(head.contains("not sound") && head.contains("<a href=\"#clouds\" class=\"error\">"));
    assert!(head.contains("<a href=\"#galaxy\" class=\"ok\">"));
    let mark = "<td class=\"mark\">error</td>";
    assert_eq!(
        (head.matches(mark).count(), rest.matches(mark).count()),
        (errors, errors)
    );
    assert!(head.contains("<a href=\"#clouds-photo\">clouds.photo</a>"));
    // A rule whose subject does not name its role is beside it all the same.
    let (_, clouds) = rest.split_once("<section id=\"clouds\">").unwrap();
    assert!(
        clouds
            .split_once("</section>")
            .unwrap()
            .0
            .contains("overcast")
    );
    let (_, green) = rest.split_once("<article id=\"sky-green\">").unwrap();
    assert!(
        green
            .split_once("</article>")
            .unwrap()
            .0
            .contains("1 values are not finite")
    );
}
