// Page of a program that serves it, or of the run in its own file.

import { ask, connect } from "./link.js";
import { start } from "./page.jsx";

start({ connect, ask });
