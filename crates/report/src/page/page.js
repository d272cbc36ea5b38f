// The report can be read without this: it adds the zone of the reader, which no browser tells a server, and a button.
'use strict';
const asked = new URLSearchParams(location.search);
const began = document.querySelector('main').dataset.began;
const moment = new Date(began);
if (!asked.has('offset') && !Number.isNaN(moment.getTime())) {
  asked.set('offset', String(-moment.getTimezoneOffset()));
  location.replace(`${location.pathname}?${asked}`);
} else {
  const print = document.getElementById('print');
  print.hidden = false;
  print.addEventListener('click', () => window.print());
}
