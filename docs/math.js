// Blocks ```math of the pages as MathML, in rustdoc and in the book: nothing is fetched for them. Of LaTeX it knows what
// the pages use; what it does not know stands in red.
(() => {
  const SIGNS = {
    alpha: "α", gamma: "γ", delta: "δ", zeta: "ζ", eta: "η", theta: "θ", kappa: "κ", nu: "ν", pi: "π", rho: "ρ", sigma: "σ", tau: "τ",
    varphi: "φ", chi: "χ", psi: "ψ", omega: "ω", Delta: "Δ", Omega: "Ω", partial: "∂",
  };
  const OPERATORS = { cdot: "·", pm: "±", ge: "≥", perp: "⊥", circ: "∘", ldots: "…", sum: "∑" };
  const FUNCTIONS = ["sin", "cos", "tan", "ln", "max", "min"];
  const SPACES = { qquad: 2, quad: 1, ",": 0.17, " ": 0.25 };
  const ACCENTS = { dot: "˙", ddot: "¨", hat: "^", bar: "¯" };
  const WORDS = { text: "mtext", mathrm: "mi mathvariant=\"normal\"" };
  // Without one that is made for formulas, indices stand on the line and dots in their letters.
  const FONTS = "STIX Two Math, Cambria Math, Latin Modern Math, Libertinus Math, DejaVu Math TeX Gyre, math";
  const TOKEN = /\\(?:text|mathrm|begin|end)\{[^}]*\}|\\[A-Za-z]+|\\.|[0-9]+(?:\.[0-9]+)?|[^\s]/gsu;

  const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
  const tag = (name, inner) => `<${name}>${inner}</${name.split(" ")[0]}>`;
  const fence = (sign, stretchy) =>
    sign === "." ? "" : tag(`mo stretchy="${stretchy}" lspace="0" rspace="0"`, escaped(sign));

  function mathml(latex) {
    const tokens = latex.match(TOKEN) || [];
    let at = 0;

    // All up to a token of these, which is left standing.
    function row(...ends) {
      let found = "";
      while (at < tokens.length && !ends.includes(tokens[at])) found += scripted();
      return tag("mrow", found);
    }

    function until(end) {
      const found = row(end);
      at += 1;
      return found;
    }

    // What a command or a script takes: a group, a sign, one digit.
    function argument() {
      if (/^\d\d/.test(tokens[at])) tokens.splice(at, 1, tokens[at][0], tokens[at].slice(1));
      return atom();
    }

    function scripted() {
      const limits = ["\\sum", "\\max", "\\min"].includes(tokens[at]) && tokens[at + 1] === "_";
      const named = FUNCTIONS.includes((tokens[at] ?? "").slice(1)), body = atom(), scripts = {};
      while (["_", "^", "'"].includes(tokens[at])) {
        const sign = tokens[at];
        at += 1;
        scripts[sign === "_" ? "_" : "^"] = sign === "'" ? tag("mo", "′") : argument();
      }
      const [sub, sup] = [scripts._, scripts["^"]], [low, high] = limits ? ["munder", "mover"] : ["msub", "msup"];
      const whole = sub && sup ? tag(limits ? "munderover" : "msubsup", body + sub + sup)
        : sub ? tag(low, body + sub) : sup ? tag(high, body + sup) : body;
      return named ? whole + tag("mspace width=\"0.17em\"", "") : whole;
    }

    // Lines under each other, cut at & into cells.
    function aligned() {
      let found = "", cells = "";
      for (;;) {
        cells += tag("mtd style=\"text-align: left; padding: 0.3em 0\"", row("&", "\\\\", "\\end{aligned}"));
        const end = tokens[at];
        at += 1;
        if (end === "&") continue;
        found += tag("mtr", cells);
        cells = "";
        if (end !== "\\\\") return tag("mtable displaystyle=\"true\"", found);
      }
    }

    function atom() {
      const token = tokens[at] ?? "", name = token.slice(1), word = /^\\(text|mathrm)\{(.*)\}$/s.exec(token);
      at += 1;
      if (token === "{") return until("}");
      if (token === "\\begin{aligned}") return aligned();
      if (word) return tag(WORDS[word[1]], escaped(word[2]).replace(/^ | $/g, "\u00a0"));
      if (!token.startsWith("\\")) {
        if (/\d/.test(token)) return tag("mn", token);
        if (/\p{L}/u.test(token)) return tag("mi", token);
        return "()[]|/".includes(token) ? fence(token, false) : tag("mo", escaped(token === "-" ? "−" : token));
      }
      if (name === "left") {
        const open = fence(tokens[at], true);
        at += 1;
        const inner = until("\\right"), close = fence(tokens[at], true);
        at += 1;
        return tag("mrow", open + inner + close);
      }
      if (name === "frac") return tag("mfrac", argument() + argument());
      if (name === "tfrac") return tag("mstyle displaystyle=\"false\"", tag("mfrac", argument() + argument()));
      if (name === "sqrt") return tag("msqrt", argument());
      if (name in ACCENTS) return tag("mover accent=\"true\"", argument() + tag("mo stretchy=\"false\"", ACCENTS[name]));
      if (name in SPACES) return tag(`mspace width="${SPACES[name]}em"`, "");
      if (name in SIGNS) return tag("mi", SIGNS[name]);
      if (name in OPERATORS) return tag("mo", OPERATORS[name]);
      if (FUNCTIONS.includes(name)) return tag("mi", name);
      return tag("mtext style=\"color: red\"", escaped(token));
    }

    return tag(`math display="block" style="font-family: ${FONTS}"`, row());
  }

  addEventListener("DOMContentLoaded", () => {
    // rustdoc marks the block, mdBook the code in it.
    document.querySelectorAll("pre.language-math > code, pre > code.language-math").forEach((code) => {
      const formula = document.createElement("div");
      formula.className = "formula";
      formula.style = "overflow-x: auto; margin: 1em 0";
      formula.innerHTML = mathml(code.textContent);
      const block = code.closest(".example-wrap") || code.parentNode;
      block.replaceWith(formula);
    });
  });
})();
