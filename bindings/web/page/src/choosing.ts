/** Regions by hand: a brush, and a lasso. */

import { Vector2, Vector3 } from "three";
import type { Hit, Surface } from "./surface.js";
import type { Viewer } from "./viewer.js";

/** The triangles up to a distance from a place that hang together with the one that was hit: nothing of the far side. */
export function brushed(surface: Surface, { point, triangle }: Hit, radius: number): Set<number> {
    const { centres, triangles } = surface;
    const near = new Map<number, number[]>();
    for (let t = 0; t < centres.length / 3; t++) {
        const [x, y, z] = [centres[3 * t]! - point.x, centres[3 * t + 1]! - point.y, centres[3 * t + 2]! - point.z];
        if (x * x + y * y + z * z < radius * radius) for (const v of triangles.subarray(3 * t, 3 * t + 3)) near.set(v, [...(near.get(v) ?? []), t]);
    }
    const found = new Set([triangle]);
    // A set that grows while it is gone through.
    for (const t of found) for (const v of triangles.subarray(3 * t, 3 * t + 3)) for (const next of near.get(v) ?? []) found.add(next);
    return found;
}

/** The triangles whose centres are seen within a polygon of places of the window. */
export function lassoed(surface: Surface, viewer: Viewer, polygon: readonly Vector2[]): number[] {
    const eye = viewer.eye.place;
    const found: number[] = [];
    const slack = 1e-3 * surface.diagonal;
    const { centres } = surface;
    for (let t = 0; t < centres.length / 3; t++) {
        const centre = new Vector3().fromArray(centres, 3 * t);
        if (!isWithin(viewer.project(centre), polygon)) continue;
        const { ray } = viewer.ray(0, 0);
        ray.origin.copy(eye);
        ray.direction.copy(centre).sub(eye).normalize();
        const hit = surface.hit(ray);
        if (hit === null || hit.point.distanceTo(eye) > centre.distanceTo(eye) - slack) found.push(t);
    }
    return found;
}

/** Whether a ray to the right crosses the polygon an odd number of times. */
function isWithin({ x, y }: Vector2, polygon: readonly Vector2[]): boolean {
    let within = false;
    polygon.forEach((a, k) => {
        const b = polygon[(k + 1) % polygon.length]!;
        if (a.y > y !== b.y > y && x < a.x + ((y - a.y) / (b.y - a.y)) * (b.x - a.x)) within = !within;
    });
    return within;
}

/** How far a movement of the pointer moves a point in a plane parallel to the picture. */
export function dragged(viewer: Viewer, point: Vector3, from: Vector2, to: Vector2): Vector3 {
    const onPlane = (at: Vector2) => {
        const { ray } = viewer.ray(at.x, at.y);
        const { ahead } = viewer.eye;
        const distance = point.clone().sub(ray.origin).dot(ahead) / ray.direction.dot(ahead);
        return ray.at(distance, new Vector3());
    };
    return onPlane(to).sub(onPlane(from));
}
