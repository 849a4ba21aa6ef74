/** The view: camera, drawing when something has changed, and rays through the pointer. */

import { BufferGeometry, Group, Mesh, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { material, type Shading, SHADINGS, wires } from "./shading.js";
import type { Surface } from "./surface.js";

/** Eye and what it looks at, in the surface's units. */
export type View = [number, number, number, number, number, number];

export class Viewer {
    readonly canvas: HTMLCanvasElement;
    readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
    readonly controls: OrbitControls;
    /** What is drawn on top: handles. */
    readonly handles = new Group();
    readonly #renderer: WebGLRenderer;
    readonly #scene = new Scene();
    readonly #after = new Mesh(new BufferGeometry(), material(1));
    readonly #before = new Mesh(new BufferGeometry(), material(-1));
    readonly #wires = new Mesh(new BufferGeometry(), wires());
    readonly #rays = new Raycaster();
    /** What lies over the picture, and is put in its place when that is new. */
    readonly overlays: (() => void)[] = [];
    #isAsked = false;
    #swipe = 0;

    constructor(canvas: HTMLCanvasElement, changed: () => void) {
        this.canvas = canvas;
        this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
        this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.#scene.add(this.#before, this.#after, this.#wires, this.handles);
        this.#before.visible = false;
        this.#wires.visible = false;
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.enableDamping = false;
        this.controls.addEventListener("change", () => (this.draw(), changed()));
        new ResizeObserver(() => this.#resize()).observe(canvas.parentElement!);
        this.#resize();
    }

    #resize(): void {
        const { clientWidth, clientHeight } = this.canvas.parentElement!;
        if (clientWidth === 0 || clientHeight === 0) return;
        this.#renderer.setSize(clientWidth, clientHeight, false);
        this.camera.aspect = clientWidth / clientHeight;
        this.camera.updateProjectionMatrix();
        this.draw();
    }

    /** Draws before the next picture of the browser, once. */
    draw(): void {
        if (this.#isAsked) return;
        this.#isAsked = true;
        requestAnimationFrame(() => {
            this.#isAsked = false;
            const cut = this.#swipe * this.#renderer.domElement.width;
            for (const { material } of [this.#before, this.#after, this.#wires]) material.uniforms["cut"]!.value = cut;
            this.#renderer.render(this.#scene, this.camera);
            for (const place of this.overlays) place();
        });
    }

    /** Shows a surface, and what it was before, left of the swipe. */
    show(after: Surface, before: Surface | null): void {
        this.#after.geometry = after.geometry;
        this.#wires.geometry = after.geometry;
        this.#before.geometry = before?.geometry ?? new BufferGeometry();
        this.#before.visible = before !== null;
        this.draw();
    }

    /** How strongly the region is coloured. */
    mark(strength: number): void {
        for (const { material } of [this.#before, this.#after]) material.uniforms["strength"]!.value = strength;
        this.draw();
    }

    /** How much of the view, from the left, shows what was before; 0 to 1. */
    swipe(part: number): void {
        this.#swipe = this.#before.visible ? part : 0;
        this.draw();
    }

    shade(shading: Shading, scale: number, hasWires: boolean): void {
        for (const { material } of [this.#before, this.#after]) {
            material.uniforms["shading"]!.value = SHADINGS.indexOf(shading);
            material.uniforms["scale"]!.value = scale;
        }
        this.#wires.visible = hasWires;
        this.draw();
    }

    /** Looks at all of the surface, from the same direction. */
    fit(surface: Surface): void {
        const direction = new Vector3(0.55, 0.45, 1);
        const { center, radius } = surface.geometry.boundingSphere!;
        const narrow = Math.min(1, this.camera.aspect);
        const distance = (1.18 * radius) / (Math.sin((Math.PI * this.camera.fov) / 360) * narrow);
        this.look([...center.clone().addScaledVector(direction.normalize(), distance).toArray(), ...center.toArray()] as View, radius);
    }

    look([x, y, z, u, v, w]: View, radius = 1): void {
        this.camera.near = radius / 200;
        this.camera.far = radius * 60;
        this.camera.position.set(x, y, z);
        this.controls.target.set(u, v, w);
        this.camera.updateProjectionMatrix();
        this.controls.update();
        this.draw();
    }

    get view(): View {
        return [...this.camera.position.toArray(), ...this.controls.target.toArray()] as View;
    }

    /** Turns by angles in radians, and comes nearer by a factor. */
    turn(right: number, up: number, nearer = 1): void {
        const away = this.camera.position.clone().sub(this.controls.target);
        const side = new Vector3().crossVectors(this.camera.up, away).normalize();
        const slope = away.angleTo(this.camera.up);
        away.applyAxisAngle(side, Math.max(0.02 - slope, Math.min(Math.PI - 0.02 - slope, -up)));
        away.applyAxisAngle(this.camera.up, right).divideScalar(nearer);
        this.camera.position.copy(this.controls.target).add(away);
        this.controls.update();
    }

    /** A ray through a place of the window. */
    ray(x: number, y: number): Raycaster {
        const { left, top, width, height } = this.canvas.getBoundingClientRect();
        this.camera.updateMatrixWorld();
        this.#rays.setFromCamera(new Vector2((2 * (x - left)) / width - 1, 1 - (2 * (y - top)) / height), this.camera);
        return this.#rays;
    }

    /** Where a point is in the window. */
    project(point: Vector3): Vector2 {
        const { left, top, width, height } = this.canvas.getBoundingClientRect();
        const seen = point.clone().project(this.camera);
        return new Vector2(left + ((seen.x + 1) / 2) * width, top + ((1 - seen.y) / 2) * height);
    }
}
