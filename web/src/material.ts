// Surfaces under one lamp beside the viewer; their colour is their own, faded into tendon, or that of a value.

import { Color, DataTexture, DoubleSide, FrontSide, RGBAFormat, ShaderMaterial, type Side, Vector2 } from "three";
import { ENTRIES, lookupTable } from "./colours";

const VERTEX = `
attribute float value;
attribute float tendon;
varying vec3 turned;
varying float level;
varying float white;
uniform vec2 range;
void main() {
  turned = normalize(normalMatrix * normal);
  level = (value - range.x) / max(range.y - range.x, 1e-12);
  white = tendon;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const FRAGMENT = `
varying vec3 turned;
varying float level;
varying float white;
uniform vec3 colour;
uniform vec3 tendonColour;
uniform sampler2D table;
uniform bool painted;
uniform float opacity;
void main() {
  vec3 normal = normalize(turned) * (gl_FrontFacing ? 1.0 : -1.0);
  vec3 lamp = normalize(vec3(-0.45, 0.55, 0.70));
  float gloss = pow(max(dot(normal, normalize(lamp + vec3(0.0, 0.0, 1.0))), 0.0), 24.0);
  float light = 0.58 + 0.50 * max(dot(normal, lamp), 0.0);
  float rim = 1.0 - 0.35 * pow(1.0 - max(normal.z, 0.0), 3.0);
  vec3 own = mix(colour, tendonColour, white);
  float strength = painted ? 0.55 : 1.0;
  vec3 paint = painted ? texture2D(table, vec2(clamp(level, 0.0, 1.0) * 0.996 + 0.002, 0.5)).rgb : own;
  gl_FragColor = vec4(paint * (1.0 + strength * (light - 1.0)) * rim + strength * 0.16 * gloss, opacity);
}`;

export interface Look {
  colour: string;
  opacity?: number;
  side?: Side;
}

export function tableTexture(): DataTexture {
  const texture = new DataTexture(lookupTable("von_mises"), ENTRIES, 1, RGBAFormat);
  texture.needsUpdate = true;
  return texture;
}

export function makeMaterial(look: Look, table: DataTexture): ShaderMaterial {
  const opacity = look.opacity ?? 1;
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    side: look.side ?? (opacity < 1 ? FrontSide : DoubleSide),
    transparent: opacity < 1,
    depthWrite: opacity === 1,
    polygonOffset: opacity < 1,
    polygonOffsetFactor: 2,
    polygonOffsetUnits: 16,
    uniforms: {
      range: { value: new Vector2(0, 1) },
      colour: { value: plain(look.colour) },
      tendonColour: { value: plain("#f7f3ea") },
      table: { value: table },
      painted: { value: false },
      opacity: { value: opacity },
    },
  });
}

/** The colour as it is written: shading is done in the picture's own space. */
function plain(hex: string): Color {
  const number = parseInt(hex.replace("#", ""), 16);
  return new Color().setRGB((number >> 16) / 255, ((number >> 8) & 255) / 255, (number & 255) / 255, "srgb-linear");
}
