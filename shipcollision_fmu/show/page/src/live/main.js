// The live pages: the bridge, and the instructor's.
import "../style.css";
import "./live.css";
