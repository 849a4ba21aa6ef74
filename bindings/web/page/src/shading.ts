/** How surfaces are coloured: plain, by reflection lines, by mean curvature; and which side of the swipe they are on. */

import { Color, DoubleSide, type IUniform, MeshPhysicalMaterial, ShaderMaterial } from "three";
import { MIRRORED, STUDIO } from "./studio.js";

/** Names of the shadings, in the order of the shader's numbers. */
export const SHADINGS = ["plain", "lines", "curvature"] as const;
export type Shading = (typeof SHADINGS)[number];

/** Colours of curvature: negative, none, positive; the exponent shows small ones, too. */
const [LOW, MIDDLE, HIGH, GAMMA] = [[0.13, 0.4, 0.67], 0.97, [0.7, 0.19, 0.12], 0.8];
const glsl = (colour: readonly number[]) => `vec3(${colour.map((x) => x.toFixed(3)).join(", ")})`;

/** What the shader of the library of drawing gets besides: which colours, and which side of the swipe. */
const DECLARED = /* glsl */ `
uniform int shading;
uniform float scale;
uniform float cut;
uniform float side;
uniform vec3 back;
uniform vec3 mark;
uniform vec3 fresh;
uniform float strength;
varying float bent;
varying float marked;
vec3 warm(float t) { return mix(vec3(${MIDDLE}), t < 0.0 ? ${glsl(LOW)} : ${glsl(HIGH)}, pow(abs(t), ${GAMMA})); }
vec3 unpacked(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }
`;

/** The colour of the surface itself, before light falls on it. */
const COLOURED = /* glsl */ `
if (!gl_FrontFacing) diffuseColor.rgb = back;
if (shading == 2) diffuseColor.rgb = unpacked(warm(clamp(bent / scale, -1.0, 1.0)));
float among = shading == 0 ? 1.0 : 0.4;
diffuseColor.rgb = mix(diffuseColor.rgb, mark, strength * among * smoothstep(0.4, 0.6, marked));
diffuseColor.rgb = mix(diffuseColor.rgb, fresh, 0.55 * among * smoothstep(0.4, 0.6, -marked));
`;

/** Reflection lines are those of parallel lamps in the direction of x, infinitely far away: they turn with the eye. */
const STRIPED = /* glsl */ `
if (shading == 1) {
    vec3 r = reflect(-normalize(vViewPosition), normal);
    float wave = sin(22.0 * atan(r.y, r.z + 1.0001));
    float width = fwidth(wave) + 0.02;
    vec3 stripes = mix(vec3(0.006, 0.008, 0.012), vec3(0.62, 0.66, 0.70), smoothstep(-width, width, wave));
    outgoingLight = mix(stripes, diffuseColor.rgb, 0.4 * strength * smoothstep(0.4, 0.6, marked)) + 0.25 * totalSpecular;
}
`;

export type SurfaceMaterial = MeshPhysicalMaterial & { uniforms: Record<string, IUniform> };

/** The material of a surface, glazed clay; side 1 is right of the swipe, -1 left of it. */
export function material(side: 1 | -1): SurfaceMaterial {
    const made = new MeshPhysicalMaterial({ color: 0xe8e5df, roughness: 0.5, clearcoat: 0.5, clearcoatRoughness: 0.22, side: DoubleSide });
    Object.assign(made, { polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    const uniforms: Record<string, IUniform> = {
        ...{ shading: { value: 0 }, scale: { value: 1 }, cut: { value: 0 }, side: { value: side }, strength: { value: 0.5 } },
        ...{ back: { value: new Color(0xc98d68) }, mark: { value: new Color(0x2aa393) }, fresh: { value: new Color(0xe0a24a) } },
    };
    made.onBeforeCompile = (shader) => {
        Object.assign(shader.uniforms, uniforms);
        const behind = (text: string, chunk: string, more: string) => text.replace(`#include <${chunk}>`, `#include <${chunk}>\n${more}`);
        const attributes = "attribute float curvature;\nattribute float chosen;\nvarying float bent;\nvarying float marked;";
        shader.vertexShader = behind(behind(shader.vertexShader, "common", attributes), "begin_vertex", "bent = curvature;\nmarked = chosen;");
        const declared = behind(behind(shader.fragmentShader, "clipping_planes_pars_fragment", STUDIO), "common", DECLARED);
        const cut = behind(declared, "clipping_planes_fragment", "#ifdef CUT\nif ((gl_FragCoord.x - cut) * side < 0.0) discard;\n#endif");
        shader.fragmentShader = behind(behind(cut, "color_fragment", COLOURED), "lights_fragment_maps", MIRRORED).replace("#include <opaque_fragment>", `${STRIPED}#include <opaque_fragment>`);
    };
    return Object.assign(made, { uniforms, defines: { ...made.defines } });
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
