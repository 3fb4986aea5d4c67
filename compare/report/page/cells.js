// The replay of a cell of a heat map: a few steps of one of its cases.

/// The cell that an address asks for, with its replay; null where there is none.
function wantedCell(wanted) {
  const index = INDEX.studies.findIndex((study) => study.key === wanted.get('study'));
  const study = INDEX.studies[index], grid = study && study.grids.find((one) => one.key === wanted.get('map'));
  const at = grid ? cellIn(grid, wanted, 'cell') : null;
  if (!at) return null;
  const [bad, all, words, command, replay] = grid.cells[at.row][at.column];
  return replay === undefined ? null : {index, study, grid, at, bad, all, words, command, replay};
}

/// What stands above and below the replay.
function cellNodes({study, grid, at, bad, all, words, command}, parameters) {
  const counted = `${bad > 0 ? grouped(bad) : 'None'} of ${grouped(all)} cases ${grid.bad_words} here`;
  const back = el('a', {href: addressOfCell(study, grid, at, 'at')}, '\u2190 Back to the map');
  return {
    above: [
      el('p', {}, back,
         el('span', {class: 'quiet'}, ` of \u201c${study.title}\u201d`, el('span', {class: 'key-hint'}, ' (Escape)'))),
      el('h2', {}, `${grid.title} at ${placeInWords(grid, at)}`),
      el('p', {class: 'sentence'}, `${counted}. This is the ${grid.labels ? 'worst' : 'first'} ${bad > 0 ? 'of those' : 'case'}: ${words}.`)
    ],
    below: [
      el('h3', {}, 'This case'), pairs(parameters),
      el('p', {class: 'quiet'}, 'All of its steps, in a terminal: ', el('code', {}, command))
    ]
  };
}
