/** How surfaces are coloured: plain, by reflection lines, by mean curvature; and which side of the swipe they are on. */

import { Color, DoubleSide, ShaderMaterial } from "three";

/** Names of the shadings, in the order of the shader's numbers. */
export const SHADINGS = ["plain", "lines", "curvature"] as const;
export type Shading = (typeof SHADINGS)[number];

const VERTEX = /* glsl */ `
attribute float curvature;
attribute float chosen;
varying vec3 at;
varying vec3 across;
varying float bent;
varying float marked;
void main() {
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    at = seen.xyz;
    across = normalMatrix * normal;
    bent = curvature;
    marked = chosen;
    gl_Position = projectionMatrix * seen;
}`;

/** Colours of curvature: negative, none, positive; the exponent shows small ones, too. */
const [LOW, MIDDLE, HIGH, GAMMA] = [[0.13, 0.4, 0.67], 0.97, [0.7, 0.19, 0.12], 0.8];
const glsl = (colour: readonly number[]) => `vec3(${colour.map((x) => x.toFixed(3)).join(", ")})`;

/** Reflection lines are those of parallel lamps in the direction of x, infinitely far away: they turn with the eye. */
const FRAGMENT = /* glsl */ `
uniform int shading;
uniform float scale;
uniform float cut;
uniform float side;
uniform vec3 front;
uniform vec3 back;
uniform vec3 mark;
uniform float strength;
varying vec3 at;
varying vec3 across;
varying float bent;
varying float marked;
vec3 warm(float t) { return mix(vec3(${MIDDLE}), t < 0.0 ? ${glsl(LOW)} : ${glsl(HIGH)}, pow(abs(t), ${GAMMA})); }
void main() {
    if ((gl_FragCoord.x - cut) * side < 0.0) discard;
    vec3 n = normalize(across) * (gl_FrontFacing ? 1.0 : -1.0);
    float light = 0.42 + 0.50 * max(dot(n, normalize(vec3(0.35, 0.6, 0.75))), 0.0) + 0.16 * max(dot(n, normalize(vec3(-0.7, -0.2, 0.4))), 0.0);
    vec3 colour = gl_FrontFacing ? front : back;
    if (shading == 1) {
        vec3 r = reflect(normalize(at), n);
        float wave = sin(22.0 * atan(r.y, r.z + 1.0001));
        float width = fwidth(wave) + 0.02;
        colour = mix(vec3(0.05, 0.07, 0.11), vec3(0.80, 0.84, 0.88), smoothstep(-width, width, wave));
        light = 0.75 + 0.25 * light;
    } else if (shading == 2) {
        colour = warm(clamp(bent / scale, -1.0, 1.0));
    }
    colour = mix(colour, mark, strength * (shading == 0 ? 1.0 : 0.4) * smoothstep(0.4, 0.6, marked));
    gl_FragColor = vec4(colour * light, 1.0);
    #include <colorspace_fragment>
}`;

/** The material of a surface; side 1 is right of the swipe, -1 left of it. */
export function material(side: 1 | -1): ShaderMaterial {
    return new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        side: DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
        uniforms: {
            shading: { value: 0 },
            scale: { value: 1 },
            cut: { value: 0 },
            side: { value: side },
            front: { value: new Color(0xa9bccf) },
            back: { value: new Color(0xb9a58e) },
            strength: { value: 0.5 },
            mark: { value: new Color(0x2f9e8f) },
        },
    });
}

const WIRE_VERTEX = "void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }";
const WIRE_FRAGMENT = "uniform float cut; void main() { if (gl_FragCoord.x < cut) discard; gl_FragColor = vec4(0.06, 0.08, 0.11, 0.3); }";

/** The material of a wireframe, right of the swipe. */
export function wires(): ShaderMaterial {
    const uniforms = { cut: { value: 0 } };
    return new ShaderMaterial({ vertexShader: WIRE_VERTEX, fragmentShader: WIRE_FRAGMENT, wireframe: true, transparent: true, uniforms });
}

/** A scale that outliers do not spoil: nineteen vertices of twenty are within it. 1, 2 or 5 times a power of ten, as scales are
 *  read; what is above its end by no more than a fiftieth, as a ball of triangles has it, counts as the end. */
export function scaleOf(values: ArrayLike<number>): number {
    const sizes = Float64Array.from(Array.from(values, Math.abs).filter(Number.isFinite)).sort();
    const most = sizes[Math.floor(0.95 * (sizes.length - 1))] || 1;
    const power = 10 ** Math.floor(Math.log10(most));
    return power * [1, 2, 5, 10].find((step) => step * power >= 0.98 * most)!;
}

/** The colours of the scale from its lower end to its upper one, as the shader mixes them. */
export function gradient(): string {
    const mixed = (t: number) => [0, 1, 2].map((k) => Math.round(255 * (MIDDLE + Math.abs(t) ** GAMMA * ((t < 0 ? LOW : HIGH)[k]! - MIDDLE))));
    const stops = Array.from({ length: 17 }, (_, k) => `rgb(${mixed(k / 8 - 1).join(" ")})`);
    return `linear-gradient(90deg, ${stops.join(", ")})`;
}
