// WebGL 2: bodies in one colour under a light, and lines.

const BODY_VERTEX = `#version 300 es
uniform mat4 view; uniform mat4 model;
layout(location = 0) in vec3 place; layout(location = 1) in vec3 normal;
out vec3 facing;
void main() { facing = mat3(model) * normal; gl_Position = view * model * vec4(place, 1.0); }`;

// Light from above and from the camera; both sides of a face are lit.
const BODY_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 colour; uniform vec3 eye;
in vec3 facing; out vec4 shown;
void main() {
  vec3 n = normalize(facing);
  n *= sign(dot(n, eye) + 1e-6);
  float light = 0.42 + 0.34 * max(dot(n, eye), 0.0) + 0.24 * max(dot(n, normalize(vec3(-0.3, -0.4, 1.0))), 0.0);
  shown = vec4(colour.rgb * light * 1.12, colour.a);
}`;

const LINE_VERTEX = `#version 300 es
uniform mat4 view; uniform mat4 model;
layout(location = 0) in vec3 place; layout(location = 1) in vec3 paint;
out vec3 ink;
void main() { ink = paint; gl_Position = view * model * vec4(place, 1.0); }`;

const LINE_FRAGMENT = `#version 300 es
precision highp float;
uniform float strength;
in vec3 ink; out vec4 shown;
void main() { shown = vec4(ink, strength); }`;

/** @typedef {{array: WebGLVertexArrayObject, buffer: WebGLBuffer, count: number}} Mesh */

class Canvas {
  /**
   * @param {HTMLCanvasElement} element
   * @param {WebGL2RenderingContext} gl
   */
  constructor(element, gl) {
    this.element = element;
    this.gl = gl;
    this.bodies = linked(gl, BODY_VERTEX, BODY_FRAGMENT, ["view", "model", "colour", "eye"]);
    this.inks = linked(gl, LINE_VERTEX, LINE_FRAGMENT, ["view", "model", "strength"]);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    // The page behind the picture shines through where nothing is drawn, and only there.
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /**
   * Corners of six numbers each: place, and normal or colour.
   * @param {Float32Array} numbers
   * @returns {Mesh}
   */
  mesh(numbers) {
    const { gl } = this;
    const mesh = { array: gl.createVertexArray(), buffer: gl.createBuffer(), count: 0 };
    gl.bindVertexArray(mesh.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer);
    for (const location of [0, 1]) {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, 3, gl.FLOAT, false, 24, location * 12);
    }
    this.refill(mesh, numbers);
    return mesh;
  }

  /**
   * Other corners for a mesh.
   * @param {Mesh} mesh
   * @param {Float32Array} numbers
   */
  refill(mesh, numbers) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
    mesh.count = numbers.length / 6;
  }

  /**
   * Begins a picture.
   * @param {Matrix} view
   * @param {Vector} eye direction to the camera
   */
  begin(view, eye) {
    const { gl, element } = this;
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [element.clientWidth * scale, element.clientHeight * scale].map(Math.round);
    if (element.width !== width || element.height !== height) {
      element.width = width;
      element.height = height;
    }
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.view = new Float32Array(view);
    this.eye = new Float32Array(eye);
  }

  /**
   * Draws a body. `back` pushes it away by a hair, so that what lies on it is seen.
   * @param {Mesh} mesh
   * @param {Matrix} model
   * @param {number[]} colour red, green, blue, opacity
   * @param {number} [back]
   */
  body(mesh, model, colour, back = 0) {
    const { gl, bodies } = this;
    gl.useProgram(bodies.program);
    gl.uniformMatrix4fv(bodies.places.view, false, this.view);
    gl.uniformMatrix4fv(bodies.places.model, false, new Float32Array(model));
    gl.uniform4fv(bodies.places.colour, colour);
    gl.uniform3fv(bodies.places.eye, this.eye);
    const clear = colour[3] < 1;
    if (clear) gl.enable(gl.BLEND);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(back, back);
    gl.bindVertexArray(mesh.array);
    gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (clear) gl.disable(gl.BLEND);
  }

  /**
   * Draws without colours: only how deep things are is kept.
   * @param {() => void} draw
   */
  onlyDepth(draw) {
    this.gl.colorMask(false, false, false, false);
    draw();
    this.gl.colorMask(true, true, true, true);
  }

  /**
   * Draws lines, two corners each. Those that lie on a face are seen because bodies are pushed back (`body`): a bias of the
   * depth itself would be many millimetres from afar, and what is inside a body would shine through.
   * @param {Mesh} mesh
   * @param {Matrix} model
   * @param {number} [strength] opacity
   * @param {number} [first]
   * @param {number} [count]
   */
  lines(mesh, model, strength = 1, first = 0, count = mesh.count) {
    if (count <= 0) return;
    const { gl, inks } = this;
    gl.useProgram(inks.program);
    gl.uniformMatrix4fv(inks.places.view, false, this.view);
    gl.uniformMatrix4fv(inks.places.model, false, new Float32Array(model));
    gl.uniform1f(inks.places.strength, strength);
    gl.bindVertexArray(mesh.array);
    gl.enable(gl.BLEND);
    gl.drawArrays(gl.LINES, first, count);
    gl.disable(gl.BLEND);
  }
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {string} vertex
 * @param {string} fragment
 * @param {string[]} names of uniforms
 */
function linked(gl, vertex, fragment, names) {
  const program = gl.createProgram();
  for (const [kind, text] of /** @type {[number, string][]} */ ([
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ])) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  const places = Object.fromEntries(names.map((name) => [name, gl.getUniformLocation(program, name)]));
  return { program, places };
}

