// The place on the surface under the pointer: told beside the picture, kept by a click, and copied as the command line takes it.
"use strict";
for (const figure of document.querySelectorAll("figure[data-depths]")) {
    const image = figure.querySelector("img");
    const camera = JSON.parse(figure.dataset.camera);
    const mark = figure.querySelector(".mark");
    const bar = figure.querySelector(".place");
    const told = bar.querySelector("output");
    const radius = bar.querySelector("input");
    let depths = null;
    let place = null;
    let isKept = false;

    const picture = new Image();
    picture.onload = () => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [picture.width, picture.height];
        const context = canvas.getContext("2d");
        context.drawImage(picture, 0, 0);
        depths = context.getImageData(0, 0, picture.width, picture.height).data;
        figure.dataset.ready = "yes";
    };
    picture.src = figure.dataset.depths;

    // See Places in src/cli/picture/places.rs. Scales and captions of the picture are right of and below what the camera sees.
    const point = (event) => {
        const box = image.getBoundingClientRect();
        const x = Math.floor(((event.clientX - box.left) * image.naturalWidth) / box.width);
        const y = Math.floor(((event.clientY - box.top) * image.naturalHeight) / box.height);
        const [width, height] = camera.size;
        if (depths === null || x < 0 || y < 0 || x >= width || y >= height) return null;
        const at = 4 * (y * width + x);
        const step = 256 * depths[at] + depths[at + 1];
        if (step === 0) return null;
        const [low, high] = camera.range;
        const z = 1 / (low + ((step - 1) / 65534) * (high - low));
        const right = (((x + 0.5 - width / 2) / camera.scale + camera.middle[0]) * z) / camera.distance;
        const up = (((height / 2 - y - 0.5) / camera.scale + camera.middle[1]) * z) / camera.distance;
        const back = camera.distance - z;
        return camera.centre.map((c, k) => c + right * camera.right[k] + up * camera.up[k] + back * camera.back[k]);
    };
    // As many digits as a pixel is wide.
    const digits = Math.min(15, Math.max(0, Math.ceil(-Math.log10(0.5 / camera.scale))));
    const numbers = () => place.map((x) => String(Number(x.toFixed(digits)) + 0)).join(",");
    const show = (event, found) => {
        place = found;
        mark.hidden = found === null;
        bar.classList.toggle("kept", isKept);
        for (const button of bar.querySelectorAll("button")) button.disabled = found === null;
        told.textContent = found === null ? "" : numbers();
        if (found === null) return;
        const box = figure.getBoundingClientRect();
        mark.style.translate = `${event.clientX - box.left}px ${event.clientY - box.top}px`;
    };
    image.addEventListener("pointermove", (event) => isKept || show(event, point(event)));
    image.addEventListener("pointerleave", (event) => isKept || show(event, null));
    image.addEventListener("click", (event) => {
        const found = point(event);
        isKept = found !== null;
        show(event, found);
    });
    for (const button of bar.querySelectorAll("button")) {
        button.addEventListener("click", async () => {
            const flag = button.dataset.flag;
            const text = `--${flag} ${numbers()}${flag === "bump" ? "" : `,${radius.value}`}`;
            try {
                await navigator.clipboard.writeText(text);
            } catch {
                // A page that is a file may have no other way.
                const field = document.body.appendChild(document.createElement("textarea"));
                field.value = text;
                field.select();
                document.execCommand("copy");
                field.remove();
            }
            told.textContent = `${numbers()}  copied: ${text}`;
        });
    }
}
