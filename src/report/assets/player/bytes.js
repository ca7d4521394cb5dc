// Columns of numbers in the page (src/report/packing.rs).

/**
 * The bytes of a column. Its numbers have their least significant byte first, as every machine has it that runs browsers.
 * @param {string} text
 */
function bytesOf(text) {
  const packed = atob(text);
  const bytes = new Uint8Array(packed.length);
  for (let i = 0; i < packed.length; i += 1) bytes[i] = packed.charCodeAt(i);
  return bytes.buffer;
}
