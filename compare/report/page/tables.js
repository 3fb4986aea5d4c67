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

// key, heading, unit, how it is written, what it means
const SAFETY = [
  ['tunnels', 'Tunnels', 'steps', count, 'Steps whose way crosses a solid and ends free of it'],
  ['steps_ending_inside', 'Ending inside', 'steps', count, 'Steps that end overlapping a solid, in exact arithmetic'],
  ['clipped', 'Clipped', 'steps', count, 'Steps that pass a solid with a rim only: no deeper than 20 mm, its unit or its pixel; no tunnels'],
  ['clipped_depth_max_m', 'Clipped by', 'm', measure, 'How deep the deepest of them is'],
  ['one_way_violations', 'One-way broken', 'steps', count, 'One-way chains passed against their normal'],
  ['max_penetration_m', 'Max penetration', 'm', measure, 'Largest exact depth at the end of a step'],
  ['max_contact_gap_m', 'Max contact gap', 'm', measure, 'Largest exact gap left at a reported contact'],
  [
    'toi_error_max', 'Impact time error', 'of a step', measure,
    'Largest error of the first time of impact, as a fraction of the step'
  ],
];
const QUALITY = [
  ['characters', 'Characters', '', count, 'That the run had; counts are sums over them'],
  ['rest_peak_to_peak_m', 'Rest jitter', 'm, peak to peak', measure, 'Movement at rest after settling'],
  ['rest_rms_m', 'Rest jitter', 'm, RMS', measure, 'Movement at rest after settling'],
  ['contact_toggles', 'Contact toggles', 'per 1000 steps', measure, 'Contacts that come and go at rest'],
  ['rest_sign_changes', 'Sign changes', 'per 1000 steps', measure, 'Of the velocity at rest: a tremble changes it in each step'],
  ['rest_upper_band', 'Upper half band', 'share', measure, 'Of the power of the motion at rest, line taken out: 1 is a flutter from step to step'],
  ['log_dimensionless_jerk', 'Smoothness', '', measure, 'Logarithm of the dimensionless jerk; larger is smoother'],
  ['seam_hop_share', 'Seam hop', 'share of speed', measure, 'Largest change of speed between two steps on level ground'],
  ['seam_hop_m', 'Seam hop', 'm', measure, 'Largest change of height between two steps on level ground'],
  [
    'max_position_difference_box2d_m', 'Max position difference to Box2D', 'm', measure,
    'Between the two runs at the same step'
  ],
  [
    'first_difference_box2d_step', 'First difference to Box2D', 'step', count,
    'First step with other sides of contact, or positions further apart than Box2D\'s skin'
  ],
  ['ghost_speed_loss', 'Snag', 'share', measure, 'Largest share of the wanted speed lost in one step to nothing exact'],
  ['crushes', 'Crushed', 'steps', count, 'Steps on which movers left no room, verified by exact arithmetic'],
  ['crushes_refuted', 'Crushed with room', 'steps', count, 'Steps on which a crush was reported and there was room'],
  ['sensor_events', 'Sensor events', '', count, 'Entries and exits that there were, exactly'],
  ['sensor_errors', 'Sensor errors', '', count, 'Entries and exits that were missed, or reported and were not'],
  ['max_sensor_error', 'Sensor time error', 'of a step', measure, 'Largest error of the fraction of a step'],
  [
    'steps_inside_after_crush', 'Inside after a crush', 'steps', count,
    'Steps that end inside nothing but what a crush brought on, verified by exact arithmetic'
  ],
  ['hanging_steps', 'Hanging', 'steps', count, 'Steps that could have fallen, and did not'],
  [
    'stuck_steps', 'Stuck', 'steps', count,
    'Steps on which it said that it is stuck inside something; they do not count for recall'
  ],
  [
    'undecided_steps', 'Undecided', 'steps', count,
    'Steps that came so near to what turns that halving the time did not tell whether they met it'
  ],
  [
    'stuck_refuted', 'Stuck, refuted', 'steps', count,
    'Steps on which it said that it is stuck, and exact arithmetic has a straight way out'
  ],
  [
    'ground_refuted', 'Ground, refuted', 'steps', count,
    'Steps on which it said that it stands, and exact arithmetic has nothing under it'
  ],
  ['wanted_motion_lost', 'Motion lost', 'share', measure, 'Share of the wanted horizontal motion lost to nothing exact'],
  ['distance_m', 'Distance', 'm', measure, 'Length of the way that was travelled'],
  ['exempted', 'Exempted', '', count, 'What was not held against it, and how often; the sizes stand in the summary'],
  ['rounding', 'Rounding', 'steps', count, 'Steps that end inside by no more than an ulp of the largest coordinate'],
  ['body_tunnels', 'Bodies through', 'steps', count, 'Steps on which a body that Box2D moves passed a solid'],
  ['body_steps_inside', 'Bodies inside', 'steps', count, 'Steps on which such a body ended inside something'],
  ['body_max_penetration_m', 'Bodies\' depth', 'm', measure, 'Largest exact depth of such a body'],
  [
    'dropped_steps', 'Displacement left over', 'steps', count,
    'Steps on which a part of the displacement was left when the iterations ran out'
  ],
  ['ns_per_step', 'Cost', 'ns per step', measure, 'Minimum of the repeats'],
  ['ns_per_step_median', 'Cost, median', 'ns per step', measure, 'Median of the repeats'],
  [
    'ns_per_step_bare', 'Cost, bare', 'ns per step', measure,
    'Box2D alone: what is wanted is known beforehand, and nothing is recorded; minimum of the repeats'
  ],
  ['ns_per_step_max', 'Cost, slowest', 'ns per step', measure, 'Maximum of the repeats'],
  [
    'impact_step_ns', 'Impact step', 'ns', measure,
    'The step of the exact first impact alone, if it is among the first 120; least of the repeats; of Box2D bare'
  ],
  ['impact_step_cold_ns', 'Impact step, cold', 'ns', measure, 'The same, after 4 MB of other memory were written'],
  ['memory_bytes', 'Memory', 'bytes', measure, 'Of a contender\'s own picture of the level'],
];
const CONTACTS = [
  ['contact_precision', 'Precision', '%, exact', share, 'Share of reported contacts that are exact, or that an exact contact deflected into; contacts in reach do not count'],
  ['contact_recall', 'Recall', '%, exact', share, 'Share of the exact contacts that were reported'],
  ['contact_band', 'In the band', '', count, 'Contacts between 1e-7 and 7e-7 m, where the guarantee lets hit and hold be either'],
  ['normal_error_max_deg', 'Normal error', 'degrees', measure, 'Largest, of the reported contacts that are exact'],
  ['contact_precision_box2d', 'Precision', '%, Box2D', share, 'Share of reported contacts that Box2D reports too'],
  ['contact_recall_box2d', 'Recall', '%, Box2D', share, 'Share of Box2D\'s contacts that were reported'],
  [
    'contact_agreement_box2d', 'Same sides as Box2D', '% of steps', share,
    'Steps on which the sides of contact are the same'
  ],
  ['first_contact_step', 'First contact', 'step', count, 'The first step with a contact'],
  ['first_contact_fraction', 'First contact', 't in the step', measure, 'Its time of impact as a fraction of the step'],
  ['contact_steps', 'With contact', 'steps', count, 'Steps with any contact'],
  ['colliders_touched', 'Colliders touched', '', count, 'Different colliders'],
  ['respawns', 'Respawns', '', count, 'Times the character was put back at the start'],
];

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
  const table = ran.length ? metricTable(ran, SAFETY, 'Safety', true) :
                             el('p', {class: 'quiet'}, 'No contender ran in this scene.');
  return [table, ...notRun(scene)];
}

function furtherTables(scene) {
  const ran = ranIn(scene);
  const nodes = [
    metricTable(ran, CONTACTS, 'Contacts', false), metricTable(ran, QUALITY, 'Rest, difference to Box2D, cost', false),
    findingsList(ran)
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
              ...SAFETY, ...CONTACTS, ...QUALITY
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
