// The live pages: the bridge, and the instructor's. Which one this is the server has written into it.
import "../style.css";
import "./live.css";
import { language } from "../texts.js";
import { startTheme } from "../theme.js";
import { startBridge } from "./bridge.js";
import { startInstructor } from "./instructor.js";

document.documentElement.lang = language();
startTheme();
document.body.classList.add("live");
(document.body.dataset.role === "instructor" ? startInstructor : startBridge)();
