// Picture of the robot's camera, asked for again and again while it is shown.

import { useEffect, useState } from "preact/hooks";
import { picture } from "./link.js";
import { WORDS } from "./words.js";

/** Milliseconds from one picture to the next. */
const PAUSE = 500;

export function Camera() {
  const [number, setNumber] = useState(0);
  const [shown, setShown] = useState(null);
  useEffect(() => {
    let timer = null;
    const image = new Image();
    const next = (src) => {
      setShown(src);
      timer = setTimeout(() => setNumber((number) => number + 1), PAUSE);
    };
    image.onload = () => next(image.src);
    image.onerror = () => next(null);
    image.src = picture(number);
    return () => {
      clearTimeout(timer);
      image.onload = image.onerror = null;
    };
  }, [number]);
  return shown ? <img class="camera" src={shown} alt={WORDS.cameraPicture} /> : <p class="empty">{WORDS.noPicture}</p>;
}
