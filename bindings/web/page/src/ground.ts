/** The ground below a surface: a soft shadow, darkest where the surface is near, as daylight makes it. */

import { BackSide, type BufferGeometry, DoubleSide, Mesh, MeshBasicMaterial, NoBlending, type Object3D, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, type Texture, Vector3, type WebGLRenderer, WebGLRenderTarget } from "three";
import { HorizontalBlurShader } from "three/examples/jsm/shaders/HorizontalBlurShader.js";
import { VerticalBlurShader } from "three/examples/jsm/shaders/VerticalBlurShader.js";

/** Pixels of the picture of the shadow: it is blurred, more are not seen; half shows steps. */
const SIZE = 256;
/** The width of what is shadowed, and how far up a surface still throws shadow, in radii of the surface. */
const [WIDTH, HEIGHT] = [3.4, 1.6];
/** How much light the shadow takes where the surface touches the ground. */
const DARKEST = 0.42;

const NEARNESS = "void main() { gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0 - gl_FragCoord.z); }";
const PLACED = "void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }";

export class Ground {
    readonly plane: Mesh;
    readonly #pictures = [0, 1].map(() => new WebGLRenderTarget(SIZE, SIZE)) as [WebGLRenderTarget, WebGLRenderTarget];
    readonly #eye = new OrthographicCamera(-0.5, 0.5, 0.5, -0.5, 0, 1);
    readonly #caster = new Mesh(undefined, new ShaderMaterial({ vertexShader: PLACED, fragmentShader: NEARNESS, side: DoubleSide, blending: NoBlending }));
    readonly #scene = new Scene().add(this.#caster);
    readonly #blurred = new Mesh(new PlaneGeometry(), undefined);
    readonly #blurs = [HorizontalBlurShader, VerticalBlurShader].map((shader) => new ShaderMaterial({ ...shader, uniforms: { tDiffuse: { value: null }, h: { value: 0 }, v: { value: 0 } }, blending: NoBlending, depthTest: false }));
    readonly #flat = new Scene().add(this.#blurred);
    #isOld = true;

    constructor() {
        const material = new MeshBasicMaterial({ map: this.#pictures[0].texture, transparent: true, opacity: DARKEST, depthWrite: false, toneMapped: false, side: BackSide });
        this.plane = new Mesh(new PlaneGeometry().rotateX(-Math.PI / 2), material);
        // Seen from below, as the picture is: left and right are kept, near and far are turned around.
        this.plane.geometry.scale(1, 1, -1);
        this.plane.renderOrder = -1;
    }

    /** The surface has another shape. */
    under(geometry: BufferGeometry, { rotation }: Object3D): void {
        this.#caster.geometry = geometry;
        this.#caster.rotation.copy(rotation);
        this.#caster.updateMatrixWorld();
        this.#isOld = true;
    }

    /** Draws the shadow anew where that is needed. */
    draw(renderer: WebGLRenderer): void {
        const { boundingSphere, boundingBox } = this.#caster.geometry;
        if (!this.#isOld || boundingSphere === null || boundingBox === null) return;
        this.#isOld = false;
        const { matrixWorld } = this.#caster;
        const { center, radius } = boundingSphere.clone().applyMatrix4(matrixWorld);
        const floor = new Vector3(center.x, boundingBox.clone().applyMatrix4(matrixWorld).min.y - 0.04 * radius, center.z);
        this.plane.position.copy(floor);
        this.plane.scale.setScalar(WIDTH * radius);
        Object.assign(this.#eye, { left: -WIDTH * radius / 2, right: WIDTH * radius / 2, top: WIDTH * radius / 2, bottom: -WIDTH * radius / 2, far: HEIGHT * radius });
        this.#eye.position.copy(floor);
        this.#eye.up.set(0, 0, 1);
        this.#eye.lookAt(floor.x, floor.y + 1, floor.z);
        this.#eye.updateProjectionMatrix();
        this.#render(renderer, this.#scene, this.#pictures[0]);
        // Twice, ever finer: one blur alone shows its samples.
        for (const width of [3, 1.2]) this.#blur(renderer, width / SIZE);
        renderer.setRenderTarget(null);
    }

    #render(renderer: WebGLRenderer, scene: Scene, into: WebGLRenderTarget): void {
        renderer.setRenderTarget(into);
        renderer.clear();
        renderer.render(scene, this.#eye);
    }

    #blur(renderer: WebGLRenderer, width: number): void {
        this.#blurred.position.copy(this.#eye.position).y += this.#eye.far / 2;
        this.#blurred.quaternion.copy(this.#eye.quaternion);
        this.#blurred.scale.setScalar(this.#eye.right - this.#eye.left);
        this.#blurs.forEach((blur, k) => {
            blur.uniforms["tDiffuse"]!.value = this.#pictures[k]!.texture as Texture;
            blur.uniforms[k === 0 ? "h" : "v"]!.value = width;
            this.#blurred.material = blur;
            this.#render(renderer, this.#flat, this.#pictures[1 - k]!);
        });
    }
}
