// Plotly sets some styles as attributes, which the page's policy forbids as it does all inline style. The same text given to
// the style object is allowed (it cannot come from markup), so such calls go there. Imported before everything else.

const { setAttribute } = Element.prototype;
Element.prototype.setAttribute = function (name, value) {
  if (name === 'style') this.style.cssText = value;
  else setAttribute.call(this, name, value);
};
