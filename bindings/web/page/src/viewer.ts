/** The view: camera, drawing when something has changed, and rays through the pointer. */

import { BufferGeometry, Group, Mesh, NeutralToneMapping, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Ground } from "./ground.js";
import { material, type Shading, SHADINGS, wires } from "./shading.js";
import { lights } from "./studio.js";
import type { Surface } from "./surface.js";

/** Eye and what it looks at, in the surface's units. */
export type View = [number, number, number, number, number, number];

/** Milliseconds that a picture waits for the one before: more are seen as steps; and after so many without one the hand rests. At half, fast machines draw
 *  coarsely now and then; at double, those without a graphics card (300 ms a picture of 1280 x 720) do not follow. */
const [SLOW, REST] = [70, 400];
/** No coarser than about this many pixels per pixel of the window, each way: at half arrows are no longer seen, at double it does not help. */
const COARSEST = 0.5;

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
    readonly #ground = new Ground();
    readonly #rays = new Raycaster();
    /** What lies over the picture, and is put in its place when that is new. */
    readonly overlays: (() => void)[] = [];
    /** Surfaces and handles, in the file's coordinates; it is turned where z points up there. */
    readonly #root = new Group();
    #isAsked = false;
    #swipe = 0;
    #hasBefore = false;
    /** Pixels of the picture per pixel of the window: fewer while it moves, where drawing is slow. */
    #sharpness = 1;
    /** How many pictures in a row have come slowly. */
    #slow = 0;
    #resting: ReturnType<typeof setTimeout> | undefined;

    /** The eye has moved. */
    changed: () => void = () => undefined;

    constructor(canvas: HTMLCanvasElement) {
        this.canvas = canvas;
        this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
        // Bright colours stay what they are.
        this.#renderer.toneMapping = NeutralToneMapping;
        this.#root.add(this.#before, this.#after, this.#wires, this.handles);
        this.#scene.add(...lights(), this.#ground.plane, this.#root);
        this.#before.visible = false;
        this.#wires.visible = false;
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.enableDamping = false;
        this.controls.addEventListener("change", () => (this.draw(), this.changed()));
        // Takes a while, elsewhere: meanwhile the page goes on.
        void this.#renderer.compileAsync(this.#scene, this.camera);
        new ResizeObserver(() => this.#resize()).observe(canvas.parentElement!);
        this.#resize();
    }

    #resize(): void {
        const { clientWidth, clientHeight } = this.canvas.parentElement!;
        if (clientWidth === 0 || clientHeight === 0) return;
        this.#renderer.setPixelRatio(this.#sharpness * Math.min(devicePixelRatio, 2));
        this.#renderer.setSize(clientWidth, clientHeight, false);
        this.camera.aspect = clientWidth / clientHeight;
        this.camera.updateProjectionMatrix();
        this.draw();
    }

    /** Draws before the next picture of the browser, once. */
    draw(): void {
        if (this.#isAsked) return;
        this.#isAsked = true;
        const asked = performance.now();
        requestAnimationFrame(() => {
            this.#isAsked = false;
            this.#pace(performance.now() - asked);
            const cut = this.#swipe * this.#renderer.domElement.width;
            for (const { material } of [this.#before, this.#after, this.#wires]) material.uniforms["cut"]!.value = cut;
            this.#ground.draw(this.#renderer);
            this.#renderer.render(this.#scene, this.camera);
            for (const place of this.overlays) place();
        });
    }

    /** Coarser pictures while they come too slowly; the last one is sharp again. */
    #pace(waited: number): void {
        clearTimeout(this.#resting);
        this.#slow = waited > SLOW ? this.#slow + 1 : 0;
        if (this.#slow > 2 && this.#sharpness > COARSEST) {
            this.#slow = 0;
            this.#sharpen(this.#sharpness * 0.67);
        }
        if (this.#sharpness < 1) this.#resting = setTimeout(() => this.#sharpen(1), REST);
    }

    #sharpen(sharpness: number): void {
        this.#sharpness = sharpness;
        this.#resize();
    }

    /** Shows a surface, and what it was before, left of the swipe. */
    show(after: Surface, before: Surface | null): void {
        this.#after.geometry = after.geometry;
        this.#wires.geometry = after.geometry;
        this.#ground.under(after.geometry, this.#root);
        this.#before.geometry = before?.geometry ?? new BufferGeometry();
        this.#hasBefore = before !== null;
        this.swipe(this.#swipe);
    }

    /** How strongly the region is coloured. */
    mark(strength: number): void {
        for (const { material } of [this.#before, this.#after]) material.uniforms["strength"]!.value = strength;
        this.draw();
    }

    /** How much of the view, from the left, shows what was before; 0 to 1. */
    swipe(part: number): void {
        this.#swipe = this.#hasBefore ? part : 0;
        const isCut = this.#swipe > 0;
        this.#before.visible = isCut;
        // Without a cut the far side is not even coloured.
        for (const { material } of [this.#before, this.#after]) {
            if ("CUT" in material.defines! === isCut) continue;
            if (isCut) material.defines!["CUT"] = "";
            else delete material.defines!["CUT"];
            material.needsUpdate = true;
        }
        this.draw();
    }

    shade(shading: Shading, scale: number, hasWires: boolean): void {
        for (const { material } of [this.#before, this.#after]) {
            // Makes room for the lines. Without them it would put the far side before the near one where both are seen from the side.
            material.polygonOffset = hasWires;
            material.uniforms["shading"]!.value = SHADINGS.indexOf(shading);
            material.uniforms["scale"]!.value = scale;
        }
        this.#wires.visible = hasWires;
        this.draw();
    }

    /** Looks at all of the surface, from the same direction. */
    fit(surface: Surface): void {
        const direction = new Vector3(0.55, 0.45, 1);
        const { center, radius } = surface.geometry.boundingSphere!.clone().applyMatrix4(this.#root.matrixWorld);
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

    /** A ray through a place of the window, in the file's coordinates. */
    ray(x: number, y: number): Raycaster {
        const { left, top, width, height } = this.canvas.getBoundingClientRect();
        this.camera.updateMatrixWorld();
        this.#rays.setFromCamera(new Vector2((2 * (x - left)) / width - 1, 1 - (2 * (y - top)) / height), this.camera);
        this.#rays.ray.applyMatrix4(this.#root.matrixWorld.clone().invert());
        return this.#rays;
    }

    /** Which axis of the file points up in the picture. */
    get up(): "y" | "z" {
        return this.#root.rotation.x === 0 ? "y" : "z";
    }

    set up(axis: "y" | "z") {
        this.#root.rotation.x = axis === "y" ? 0 : -Math.PI / 2;
        this.#root.updateMatrixWorld();
    }

    /** Where the eye is, and what is ahead and to the right of it, in the file's coordinates. */
    get eye(): { place: Vector3; ahead: Vector3; right: Vector3 } {
        this.camera.updateMatrixWorld();
        const [place, ahead, right] = [this.camera.position.clone(), this.camera.getWorldDirection(new Vector3()), new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0)];
        const back = this.#root.quaternion.clone().invert();
        for (const each of [place, ahead, right]) each.applyQuaternion(back);
        return { place, ahead, right };
    }

    /** Where a point is in the window. */
    project(point: Vector3): Vector2 {
        const { left, top, width, height } = this.canvas.getBoundingClientRect();
        const seen = point.clone().applyQuaternion(this.#root.quaternion).project(this.camera);
        return new Vector2(left + ((seen.x + 1) / 2) * width, top + ((1 - seen.y) / 2) * height);
    }
}
