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
const colours = ['#0b5cad', '#b3261e', '#1d7a3a', '#8a5a00', '#6a3fa0'];
const marks = ['circle', 'rect', 'triangle', 'rectRot', 'star'];
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [5, 5]];
const text = getComputedStyle(document.body).getPropertyValue('--text');
const rule = getComputedStyle(document.body).getPropertyValue('--rule');
const canvas = document.getElementById('chart');
canvas.setAttribute('aria-label', data.chart.title);
// Whole powers of ten carry a label; the rest only a line.
const powers = (value) => (Number.isInteger(Math.round(Math.log10(value) * 1e9) / 1e9) ? value.toLocaleString('en') : '');
const axis = (title) => ({
  type: 'logarithmic',
  title: { display: true, text: title, color: text },
  ticks: { color: text, callback: powers, maxRotation: 0 },
  grid: { color: rule },
});
new Chart(canvas, {
  type: 'line',
  data: {
    datasets: data.chart.series.map((series, i) => ({
      label: series.name,
      data: series.points,
      borderColor: colours[i % colours.length],
      backgroundColor: colours[i % colours.length],
      pointStyle: marks[i % marks.length],
      pointRadius: 5,
      borderDash: dashes[i % dashes.length],
    })),
  },
  options: {
    animation: false,
    maintainAspectRatio: false,
    color: text,
    plugins: { legend: { labels: { usePointStyle: true } }, title: { display: true, text: data.chart.title, color: text } },
    scales: { x: axis(data.chart.x), y: axis(data.chart.y) },
  },
});
