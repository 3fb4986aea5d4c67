// Small pictures of the steps on which two sides differ.

function contactsInWords(contacts) {
  return contacts.map(({side, collider}) => `${side}, ${collider}`).join('; ') || 'no contact';
}

function boxOfStatements(disagreement) {
  const box = nothing();
  for (const {run, record} of disagreement.statements)
    for (const corner of [record.path[0], record.path.at(-1)]) boxOf(movedBox(boxOf(run.hull), corner), box);
  return box;
}

function drawDisagreement(canvas, disagreement, names) {
  const painter = new Painter(canvas), camera = new Camera();
  camera.fit(boxOfStatements(disagreement), canvas.clientWidth, canvas.clientHeight, 0.16);
  painter.begin(camera, theme());
  const [first] = disagreement.statements;
  painter.scenery(first.run.scenery, first.record, 1);
  for (const {run, record: {path, contacts}} of disagreement.statements) {
    const {colour, dash} = inkOf(run, names);
    painter.octagon(run.hull, path[0][0], path[0][1], {colour, dash: [2, 3], alpha: 0.45});
    painter.octagon(run.hull, path.at(-1)[0], path.at(-1)[1], {colour, fill: true, dash});
    contacts.forEach((contact) => painter.contact(contact, colour, 22));
  }
  painter.scaleBar();
}

function disagreementCard(disagreement, names, goTo) {
  const canvas = el('canvas', {role: 'img', 'aria-label': `Step ${disagreement.step}: ${disagreement.who_is_right}`});
  const says = disagreement.statements.map(
      ({run, record}) =>
          el('p', {}, el('span', {class: 'swatch', style: `border-color:${inkOf(run, names).colour}`}),
             `${run.label}: ${contactsInWords(record.contacts)}`));
  const card =
      el('div', {class: 'card'}, canvas, says, el('p', {class: 'right'}, disagreement.who_is_right),
         el('button', {type: 'button', onclick: () => goTo(disagreement)}, `Go to step ${disagreement.step}`));
  return {card, draw: () => drawDisagreement(canvas, disagreement, names)};
}

function disagreementsSection(replay, names, goTo) {
  const drawable = replay.disagreements.filter((disagreement) => disagreement.statements.length > 0);
  if (drawable.length === 0) return {nodes: [], draw: () => {}};
  const cards = drawable.map((disagreement) => disagreementCard(disagreement, names, goTo));
  const said = drawable.length < replay.disagreementsInAll ?
      `${drawable.length} of ${grouped(replay.disagreementsInAll)} disagreements are drawn.` :
      `${drawable.length} ${drawable.length === 1 ? 'disagreement' : 'disagreements'}.`;
  return {
    nodes: [
      el('h3', {}, 'Disagreements'),
      el('p', {class: 'quiet'},
         `${said} Dotted: where the step began. Filled: where it ended. Arrows: contact normals.`),
      el('div', {class: 'cards'}, cards.map(({card}) => card))
    ],
    draw: () => cards.forEach(({draw}) => draw()),
  };
}
