// The page of theory within rustdoc: sources that it names are rustdoc's own pages of them. Other pages of docs/ are not
// there, and their names are words.
addEventListener("DOMContentLoaded", () => {
  document.querySelectorAll(".docblock a[href^='../']:not([href^='../src/']), .docblock a[href*='.md']").forEach((link) => {
    const [, crate, file] = /^(?:\.\.\/)+(?:crates\/([a-z-]+)\/)?src\/(.+\.rs)$/.exec(link.getAttribute("href")) || [];
    const name = crate ? `brinell_${crate.replace("-", "_")}` : "brinell";
    if (file) link.href = `../src/${name}/${file}.html`;
    else link.replaceWith(...link.childNodes);
  });
});
