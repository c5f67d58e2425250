// Puts a button under each policy of the book that opens it in the playground, if that is served beside the book.
(() => {
  const root = typeof path_to_root === "string" ? path_to_root : "";
  const link = (text) => {
    const bytes = Array.from(new TextEncoder().encode(text), (byte) => String.fromCharCode(byte)).join("");
    const policy = btoa(bytes).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
    const [, robot, scene] = /Robot ([a-z0-9_]+), scene ([a-z0-9_]+)\./.exec(text) ?? [, "hsr", "kitchen"];
    return `${root}playground/index.html#policy=${policy}&robot=${robot}&scene=${scene}`;
  };
  for (const code of document.querySelectorAll("code.language-motet")) {
    const text = code.textContent;
    if (!/^\s*(export )?policy /m.test(text)) continue;
    const button = document.createElement("a");
    button.className = "button";
    button.href = link(text);
    button.target = "_blank";
    button.rel = "noopener";
    button.textContent = "Run";
    button.title = "Open this policy in the playground";
    code.parentElement.after(button);
  }
})();
