'use strict';

const data = JSON.parse(document.getElementById('data').textContent);

function add(parent, tag, text) {
  const element = document.createElement(tag);
  element.textContent = text;
  parent.append(element);
  return element;
}

document.title = 'paperproof: ' + data.title;
document.getElementById('title').textContent = data.title;
for (const paragraph of data.paragraphs) add(document.getElementById('text'), 'p', paragraph);

function addRow(table, tag, cells) {
  const row = add(table, 'tr', '');
  for (const cell of cells) add(row, tag, cell).className = Number.isNaN(Number(cell)) ? 'words' : '';
}
const table = document.getElementById('table');
addRow(table, 'th', data.heading);
for (const cells of data.rows) addRow(table, 'td', cells);

for (const [name, value] of data.environment) {
  add(document.getElementById('environment'), 'dt', name);
  add(document.getElementById('environment'), 'dd', value);
}

// Distinct without colour, too: each series has its own mark and dash.
const colours = ['#0b5cad', '#b3261e', '#1d7a3a', '#8a5a00', '#6a3fa0', '#0a7f86', '#c2185b', '#5d6b00', '#7a4b2a', '#4d5c6b'];
const marks = ['circle', 'rect', 'triangle', 'rectRot', 'star', 'crossRot'];
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [5, 5]];
const text = getComputedStyle(document.body).getPropertyValue('--text');
const rule = getComputedStyle(document.body).getPropertyValue('--rule');
// Whole powers of ten carry a label; the rest only a line.
const powers = (value) => {
  const power = Math.round(Math.log10(value) * 1e9) / 1e9;
  if (!Number.isInteger(power)) return '';
  return Math.abs(power) > 5 ? '1e' + power : value.toLocaleString('en', { maximumSignificantDigits: 1 });
};
const axis = (title) => ({
  type: 'logarithmic',
  title: { display: true, text: title, color: text },
  ticks: { color: text, callback: powers, maxRotation: 0 },
  grid: { color: rule },
});
function draw(chart) {
  const box = add(document.getElementById('charts'), 'div', '');
  box.className = 'chart';
  const canvas = add(box, 'canvas', '');
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', chart.title);
  new Chart(canvas, {
    type: 'line',
    data: {
      datasets: chart.series.map((series, i) => ({
        label: series.name,
        data: series.points,
        borderColor: colours[i % colours.length],
        backgroundColor: colours[i % colours.length],
        pointStyle: marks[i % marks.length],
        pointRadius: 5,
        borderDash: dashes[Math.floor(i / 2) % dashes.length],
      })),
    },
    options: {
      animation: false,
      maintainAspectRatio: false,
      color: text,
      plugins: {
        legend: { labels: { usePointStyle: true } },
        title: { display: true, text: chart.title, color: text },
      },
      scales: { x: axis(chart.x), y: axis(chart.y) },
    },
  });
}
data.charts.forEach(draw);

// From all hold to none holds: blue to orange, which most eyes tell apart; the numbers say it, too.
function colourOf(cell) {
  if (cell.all === 0) return 'transparent';
  const bad = cell.bad / cell.all;
  return `hsl(${bad > 0 ? 28 : 205} ${bad > 0 ? 90 : 60}% ${bad > 0 ? 80 - 25 * bad : 75}%)`;
}
function drawGrid(grid) {
  const box = add(document.getElementById('grids'), 'div', '');
  box.className = 'grid wide';
  add(box, 'h3', grid.title);
  const body = add(box, 'table', '');
  const head = add(body, 'tr', '');
  add(head, 'th', grid.y + ' \\ ' + grid.x);
  for (const x of grid.xs) add(head, 'th', x);
  grid.cells.forEach((cells, row) => {
    const line = add(body, 'tr', '');
    add(line, 'th', grid.ys[row]);
    for (const cell of cells) {
      const button = add(add(line, 'td', ''), 'button', cell.all === 0 ? '–' : cell.bad === 0 ? 'holds' : `${cell.bad}/${cell.all}`);
      button.style.background = colourOf(cell);
      if (cell.all === 0) button.style.color = 'inherit';
      button.title = cell.words;
      button.addEventListener('click', () => { document.getElementById('told').textContent = cell.words; });
    }
  });
}
data.grids.forEach(drawGrid);
