// Small pictures of the steps on which two sides differ.

function contactWords(contact, colliders) {
  const collider = colliders[contact.collider];
  return `${contact.side}, ${collider ? collider.id : `collider ${contact.collider}`}`;
}

function contactsInWords(contacts, colliders) {
  if (contacts.length === 0) return 'no contact';
  return contacts.map((contact) => contactWords(contact, colliders)).join('; ');
}

function boxOfStatements(disagreement) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const {run, from, to} of disagreement.statements) {
    const hull = boxOf(run.hull);
    for (const p of [from, to]) boxOf([hull[0] + p.x, hull[1] + p.y, hull[2] + p.x, hull[3] + p.y], box);
  }
  return box;
}

function drawDisagreement(canvas, disagreement, names) {
  const painter = new Painter(canvas), camera = new Camera();
  camera.fit(boxOfStatements(disagreement), canvas.clientWidth, canvas.clientHeight, 0.16);
  painter.begin(camera, theme());
  const {run: first} = disagreement.statements[0], record = first.steps[Math.max(indexAt(first, disagreement.step), 0)];
  painter.scenery(first.scenery, record ? offsetsAt(record, 1) : []);
  for (const {run, from, to, contacts} of disagreement.statements) {
    const {colour, dash} = inkOf(run, names);
    painter.octagon(run.hull, from.x, from.y, {colour, dash: [2, 3], alpha: 0.45});
    painter.octagon(run.hull, to.x, to.y, {colour, fill: true, dash});
    contacts.forEach((contact) => painter.contact(contact, colour, 22));
  }
  for (const contact of disagreement.exact || []) painter.contact(contact, painter.colours.text, 14);
  painter.scaleBar();
}

function disagreementCard(disagreement, names, goTo) {
  const canvas = el('canvas', {role: 'img', 'aria-label': `Step ${disagreement.step}: ${disagreement.whoIsRight}`});
  const says = disagreement.statements.map(
      ({run, contacts}) =>
          el('p', {}, el('span', {class: 'swatch', style: `border-color:${inkOf(run, names).colour}`}),
             `${run.label}: ${contactsInWords(contacts, run.scenery.colliders)}`));
  const colliders = disagreement.statements[0].run.scenery.colliders;
  const exact = disagreement.exact ? el('p', {}, el('span', {class: 'swatch', style: 'border-color:var(--text)'}),
                                        `exact: ${contactsInWords(disagreement.exact, colliders)}`) :
                                     null;
  const card =
      el('div', {class: 'card'}, canvas, says, exact, el('p', {class: 'right'}, disagreement.whoIsRight),
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
         `${said} Dotted: where the step began. Filled: where it ended. Arrows: contact normals; ` +
             'short ones in the text colour are the exact contacts.'),
      el('div', {class: 'cards'}, cards.map(({card}) => card))
    ],
    draw: () => cards.forEach(({draw}) => draw()),
  };
}
