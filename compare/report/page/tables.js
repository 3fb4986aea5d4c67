// The summary and the tables. Text only ever enters the page through textContent.

function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === undefined || value === null) continue;
    if (name.startsWith('on'))
      element.addEventListener(name.slice(2), value);
    else
      element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

const MINUS = '\u2212', THIN = '\u2009';

function grouped(number) {
  const digits = String(Math.abs(number)).replace(/\B(?=(\d{3})+$)/g, THIN);
  return (number < 0 ? MINUS : '') + digits;
}

/// A measure with three significant digits: plain where that is short, else with a power of ten.
function measure(number) {
  if (typeof number === 'string') return number;
  if (number === 0) return '0';
  const size = Math.abs(number);
  if (size >= 1e-3 && size < 1e5) return Number(number.toPrecision(3)).toString().replace('-', MINUS);
  const [mantissa, exponent] = number.toExponential(1).split('e');
  return `${mantissa.replace('-', MINUS)}e${exponent.replace('+', '').replace('-', MINUS)}`;
}

const count = (value) => (typeof value === 'string' ? value : grouped(value));
const share = (value) =>
    (typeof value === 'string' ?
         value :
         (value * 100 >= 99.995 || value === 0 ? (value * 100).toFixed(0) : (value * 100).toFixed(2)));

const WRITERS = {count, flag: (value) => (value === true ? 'yes' : value === false ? 'no' : value)};
const EXEMPTED =
    ['exempted', 'Exempted', '', count, 'What was not held against it, and how often; the sizes stand in the summary'];

/// A column for each metric of a group: its key, title, unit, writer and meaning.
function columnsOf(group) {
  const columns = INDEX.metrics.filter((metric) => metric.group === group).map(({key, title, unit, kind, meaning}) => {
    const [name, write] = unit === 'share' ? ['%', share] : [unit, WRITERS[kind] || measure];
    return [key, title, name, write, meaning];
  });
  return group === 'progress' ? [...columns, EXEMPTED] : columns;
}

function rowLabel(row) {
  return runLabel(row);
}

function heading([, title, unit, , meaning]) {
  return el(
      'th', {scope: 'col', class: 'number', title: meaning}, el('span', {class: 'title'}, title),
      el('span', {class: 'unit'}, unit || '\u00a0'));
}

function verdictCell(row) {
  return el('td', {}, el('span', {class: `verdict ${row.verdict.replace(' ', '-')}`}, row.verdict));
}

/// A table that scrolls by itself where it is wider than the page.
function tableBox(label, parts, kind = '') {
  return el(
      'div', {class: `table-box ${kind}`, tabindex: '0', role: 'region', 'aria-label': label || 'Table'}, el('table', {}, parts));
}

/// A table of the columns that anyone has; null if nobody has any.
function metricTable(rows, columns, caption, withVerdict) {
  const used = columns.filter(([key]) => rows.some((row) => row[key] !== undefined));
  if (used.length === 0 && !withVerdict) return null;
  const head = [el('th', {scope: 'col'}, 'Contender')];
  if (withVerdict)
    head.push(
        el('th', {scope: 'col'}, 'Verdict'),
        el('th', {scope: 'col', class: 'number'}, el('span', {class: 'title'}, 'Ran'),
           el('span', {class: 'unit'}, 'steps')));
  const body = rows.map(
      (row) => el(
          'tr', {}, el('th', {scope: 'row'}, rowLabel(row)),
          withVerdict ? [verdictCell(row), el('td', {class: 'number'}, grouped(row.steps))] : [],
          used.map(([key, , , write]) => el('td', {class: 'number'}, row[key] === undefined ? '' : write(row[key])))));
  return tableBox(caption, [
    el('caption', {}, caption), el('thead', {}, el('tr', {}, head, used.map(heading))), el('tbody', {}, body)
  ]);
}

function withoutStop(sentence) {
  return sentence.replace(/\.$/, '');
}

/// One item for each contender that there is something to say about.
function findingsList(rows) {
  const items = rows.flatMap((row) => {
    const words = [row.reason, ...row.findings].filter(Boolean);
    return words.length === 0 ?
        [] :
        [el('li', {}, el('strong', {}, rowLabel(row)), `: ${words.map(withoutStop).join('. ')}.`)];
  });
  return items.length === 0 ? null : el('ul', {class: 'findings'}, items);
}

function ranIn(scene) {
  return scene.rows.filter((row) => row.verdict !== 'not applicable');
}

/// Those who could not run in a scene, with the reason that they share.
function notRun(scene) {
  const byReason = new Map();
  for (const row of scene.rows) {
    if (row.verdict !== 'not applicable') continue;
    // A reason may begin with the name of the contender, which would keep equal ones apart.
    const named = row.reason.startsWith(`${row.contender} `);
    const shared = named ? `each${row.reason.slice(row.contender.length)}` : row.reason;
    byReason.set(shared, [...(byReason.get(shared) || []), row]);
  }
  return [...byReason].map(([shared, rows]) => {
    const reason = withoutStop(rows.length > 1 ? shared : rows[0].reason);
    return el('p', {class: 'quiet'}, `Not run: ${rows.map(rowLabel).join(', ')} (${reason}).`);
  });
}

/// What a scene was run for, and who may not be compared.
function safetyTable(scene) {
  const ran = ranIn(scene);
  const table = ran.length ? metricTable(ran, columnsOf('safety'), 'Safety', true) :
                             el('p', {class: 'quiet'}, 'No contender ran in this scene.');
  return [table, ...notRun(scene)];
}

function furtherTables(scene) {
  const ran = ranIn(scene);
  const tables = [['contacts', 'Contacts'], ['progress', 'Progress'], ['jitter', 'Rest and seams'], ['cost', 'Cost']];
  const nodes = [
    ...tables.map(([group, title]) => metricTable(ran, columnsOf(group), title, false)), findingsList(ran)
  ].filter(Boolean);
  return nodes.length ? [el('h3', {}, 'More about the runs'), ...nodes] : [];
}

// --- Summary ---

function sum(rows, key) {
  return rows.reduce((total, row) => total + (typeof row[key] === 'number' ? row[key] : 0), 0);
}

/// Contenders over all scenes, in the order in which they first appear.
function byContender(scenes) {
  const groups = new Map();
  scenes.forEach((scene) => scene.rows.forEach((row) => {
    const label = rowLabel(row);
    if (!groups.has(label)) groups.set(label, []);
    groups.get(label).push({...row, key: scene.key, sceneName: scene.name});
  }));
  return groups;
}

/// Where a scene is in this page, with one contender alone where that is named.
function addressOf(key, contender) {
  return `#scene=${encodeURIComponent(key)}` + (contender ? `&contender=${encodeURIComponent(contender)}` : '');
}

function sceneLinks(rows) {
  const link = (row) => el('a', {href: addressOf(row.key, row.contender)}, row.sceneName);
  const joined = (list) => list.flatMap((row, i) => (i === 0 ? [link(row)] : [', ', link(row)]));
  if (rows.length === 0) return [];
  if (rows.length <= 4) return joined(rows);
  return [el('details', {}, el('summary', {}, `${rows.length} scenes`), joined(rows))];
}

function largest(rows, key) {
  const values = rows.map((row) => row[key]).filter((value) => value !== undefined);
  if (values.length === 0) return '';
  return values.find((value) => typeof value === 'string') || measure(Math.max(...values));
}

function summaryRow(label, rows) {
  const ran = rows.filter((row) => row.verdict !== 'not applicable');
  const verdicts = (name) => ran.filter((row) => row.verdict === name).length;
  const counted = (value) => el('td', {class: 'number'}, grouped(value));
  const judged = (key) =>
      (ran.some((row) => row[key] !== undefined) ? counted(sum(ran, key)) : el('td', {class: 'number'}));
  return el(
      'tr', {}, el('th', {scope: 'row'}, label), counted(ran.length), counted(sum(ran, 'steps')),
      counted(verdicts('holds')), judged('tunnels'), judged('steps_ending_inside'),
      el('td', {class: 'number'}, largest(ran, 'max_penetration_m')), counted(verdicts('flagged')),
      counted(rows.length - ran.length));
}

function summaryTable(groups) {
  const columns = [
    ['Scenes', 'ran'], ['Steps', ''], ['Held', 'scenes'], ['Tunnels', 'steps'], ['Ending inside', 'steps'],
    ['Max penetration', 'm'], ['Flagged', 'scenes'], ['Not applicable', 'scenes']
  ];
  const head = columns.map(([title, unit]) => heading([null, title, unit, null, null]));
  return tableBox('All contenders over all scenes', [
    el('caption', {}, 'All contenders over all scenes'),
    el('thead', {}, el('tr', {}, el('th', {scope: 'col'}, 'Contender'), head)),
    el('tbody', {}, [...groups].map(([label, rows]) => summaryRow(label, rows)))
  ]);
}

/// For each contender the scenes in which it did worse than to hold.
function troubleList(groups) {
  const items =
      [...groups]
          .map(([label, rows]) => {
            const trouble = rows.filter((row) => ['tunnels', 'violates', 'failed'].includes(row.verdict));
            return trouble.length === 0 ? null : el('li', {}, el('strong', {}, label), ': ', sceneLinks(trouble));
          })
          .filter(Boolean);
  return items.length === 0 ?
      [] :
      [el('h3', {}, 'Who tunnelled, broke a guarantee or failed, and where'), el('ul', {class: 'findings'}, items)];
}

/// One sentence each for those who held everywhere, and for those who did not.
function whoHeld(groups) {
  const held = [], others = [];
  for (const [label, rows] of groups) {
    const judged = rows.filter((row) => row.verdict !== 'not applicable');
    if (judged.length === 0) continue;
    const bad = judged.filter((row) => row.verdict !== 'holds').length;
    if (bad === 0)
      held.push(`${label} (${judged.length})`);
    else
      others.push(`${label} (held in ${judged.length - bad} of ${judged.length})`);
  }
  return [
    held.length ? `Held in every scene it ran in: ${held.join(', ')}.` : 'No contender held in every scene.',
    others.length ? `Not in every scene: ${others.join(', ')}.` : '',
  ].filter(Boolean);
}

function pairs(list) {
  return el('dl', {class: 'pairs'}, list.flatMap(([name, value]) => [el('dt', {}, name), el('dd', {}, value)]));
}

function definitions() {
  return el('details', {}, el('summary', {}, 'What the columns mean'), pairs([
              ...['safety', 'contacts', 'progress', 'jitter', 'cost'].flatMap(columnsOf)
            ].map(([, title, unit, , meaning]) => [unit ? `${title} (${unit})` : title, meaning])));
}

/// A list that is opened by a click.
function folded(title, nodes) {
  return nodes.length === 0 ? [] : [el('details', {}, el('summary', {}, title), nodes)];
}

function bullets(lines) {
  return lines.length === 0 ? [] : [el('ul', {class: 'findings'}, lines.map((line) => el('li', {}, line)))];
}

function inNumbers(index, groups) {
  const steps = index.scenes.reduce((total, scene) => total + sum(scene.rows, 'steps'), 0);
  const scenes = `${grouped(index.scenes.length)} ${index.scenes.length === 1 ? 'scene' : 'scenes'}`;
  return [
    el('h3', {}, 'All scenes in numbers'),
    el('p', {},
       `${scenes}, ${groups.size} ${groups.size === 1 ? 'contender' : 'contenders'}, ${grouped(steps)} steps in all. ` +
           'A scene is held where the verdict is holds: nothing is passed or entered, the exact answer is met, nothing hangs; ' +
           'both are decided in exact arithmetic from the trace.'),
    whoHeld(groups).map((words) => el('p', {}, words)),
    summaryTable(groups),
    ...troubleList(groups),
  ].flat();
}

function sectionNodes({lines, table}) {
  const [heading, ...rows] = table;
  const drawn = !heading ? [] : [tableBox('', [
    el('thead', {}, el('tr', {}, heading.map((words) => el('th', {scope: 'col'}, words)))),
    el('tbody', {}, rows.map(([name, ...cells]) => el('tr', {}, el('th', {scope: 'row'}, name), cells.map((words) => el('td', {}, words)))))
  ], 'words')];
  return [...drawn, ...bullets(lines)];
}

/// Definitions, tolerances, exemptions, versions and flags: each one click away.
function howItWasMeasured(index) {
  return [
    el('h3', {}, 'How it was measured'),
    ...folded('The guarantee, and its violations counted', bullets(index.guarantee_notes)),
    ...index.sections.flatMap((section) => folded(section.title, sectionNodes(section))),
    ...folded('Versions, flags and machine', index.environment.length ? [pairs(index.environment)] : []),
    ...folded('Tolerances [m]', index.tolerances.length ? [pairs(index.tolerances.map(([name, metres]) => [name, measure(metres)]))] : []),
    definitions(),
    el('p', {class: 'quiet'},
       'Numbers in this page are rounded for display. The trace files hold every number to the last bit.'),
  ];
}
