//! The example of docs/datasets.md is the one that is tested.

#[test]
fn the_page_has_the_example_that_is_tested() {
    let page = include_str!("../../../docs/datasets.md");
    let example = include_str!("../../../viewer/src/sample/ranges.toml");
    assert!(page.contains(&format!("```toml\n{example}```\n")));
}
