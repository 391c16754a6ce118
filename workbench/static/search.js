// Which titles hold all words of a search.

// What would go on with a word: digits with a number, letters with a name ("40" ends in "40degC", "40deg" does not).
const more = (end) => (/\d/.test(end) ? "\\p{N}" : "\\p{L}");

// A word that stands somewhere as a whole means that alone; else it is one that is being typed.
export function matcher(text, titles) {
  const tests = text
    .toLowerCase()
    .split(/\s+/)
    .filter(Boolean)
    .map((word) => {
      const plain = word.replace(/[.*+?^${}()|[\]\\/-]/g, "\\$&"),
        whole = new RegExp(`(?<!${more(word[0])})${plain}(?!${more(word.at(-1))})`, "u");
      return titles.some((title) => whole.test(title.toLowerCase())) ? (title) => whole.test(title) : (title) => title.includes(word);
    });
  return (title) => tests.every((test) => test(title.toLowerCase()));
}
