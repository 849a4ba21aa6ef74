/**
 * Soft light as a photographer sets it: what a polished surface mirrors, as a function of direction. A fair surface is known by how lamps run
 * over it. three.js' filtered map of a room looks much the same, but takes 3 s to make where there is no graphics card; this takes nothing.
 */

import { type ColorRepresentation, DirectionalLight, HemisphereLight, Vector3 } from "three";

/** A lamp: where it hangs, half its width and height as tangents of angles, and how bright it is. */
const LAMPS: [place: Vector3, width: number, height: number, light: number][] = [
    [new Vector3(-0.35, 1, 0.3), 0.75, 0.5, 2.6],
    [new Vector3(-1, 0.3, 0.35), 0.16, 0.95, 2.4],
    [new Vector3(1, 0.35, 0.5), 0.22, 0.6, 1.5],
    [new Vector3(0.2, 0.3, -1), 1.2, 0.6, 0.7],
];

const vector = ({ x, y, z }: Vector3) => `vec3(${[x, y, z].map((k) => k.toFixed(5)).join(", ")})`;

function lamp([place, width, height, light]: (typeof LAMPS)[number]): string {
    const towards = place.clone().normalize();
    const right = new Vector3(0, 1, 0).cross(towards).normalize();
    const up = towards.clone().cross(right);
    const sizes = `vec2(${width.toFixed(3)}, ${height.toFixed(3)})`;
    return `    seen += ${light.toFixed(3)} * lamp(r, ${vector(towards)}, ${vector(right)}, ${vector(up)}, ${sizes}, blur);`;
}

/** What comes from a direction of the world; rougher surfaces see it blurred. */
export const STUDIO = /* glsl */ `
float lamp(vec3 r, vec3 towards, vec3 right, vec3 up, vec2 size, float blur) {
    float ahead = dot(r, towards);
    vec2 off = size - abs(vec2(dot(r, right), dot(r, up))) / max(ahead, 0.05);
    vec2 within = smoothstep(-blur, blur, off);
    return step(0.05, ahead) * within.x * within.y * min(1.0, size.x / blur) * min(1.0, size.y / blur);
}
vec3 studio(vec3 r, float roughness) {
    float blur = 0.04 + 1.3 * roughness * roughness;
    float seen = mix(0.22, 0.75, smoothstep(-0.7, 0.5, r.y));
${LAMPS.map(lamp).join("\n")}
    return seen * mix(vec3(1.0, 0.985, 0.96), vec3(0.95, 0.98, 1.0), 0.5 + 0.5 * r.x);
}
`;

/** Lets the studio be mirrored: for the place in a shader where three.js adds its own maps. */
export const MIRRORED = /* glsl */ `
#ifdef RE_IndirectSpecular
    vec3 mirrored = inverseTransformDirection(reflect(-geometryViewDir, geometryNormal), viewMatrix);
    // Colours that are read as numbers are not outshone.
    float share = shading == 2 ? 0.3 : 1.0;
    radiance += share * studio(mirrored, material.roughness);
    #ifdef USE_CLEARCOAT
        clearcoatRadiance += share * studio(mirrored, material.clearcoatRoughness);
    #endif
#endif
`;

/** The light that falls on dull surfaces: from the sky, from the ground, and a little sun. */
export function lights(): [HemisphereLight, DirectionalLight] {
    const [sky, ground, sun]: ColorRepresentation[] = [0xf6f9ff, 0xcdc4b9, 0xfff3e4];
    const falling = new DirectionalLight(sun, 1.7);
    falling.position.set(-0.55, 1, 0.6);
    return [new HemisphereLight(sky, ground, 2.15), falling];
}
